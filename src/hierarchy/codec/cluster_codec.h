// How the triangles and vertices of a page's clusters become bytes: an edge-and-vertex code for the triangles, and
// what prediction from the triangle next door leaves over of the vertices.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Appends vertices and triangles of all clusters of `page`, and what `fields` its vertices have. Exact for any valid
/// page; short for one that went through orderForCoding. Returns the places in `out` where bytes of one kind end:
/// compressors do better by treating each kind by itself. The last is the end.
std::vector<std::size_t> encodeClusters(const Page& page, ByteWriter& out, const PageFields& fields = {});

/// The reverse: fills `page.vertices`, `page.triangles` and the boxes of `page.clusters`, whose ranges are already
/// there and tile; and `fields`, if there is any. Throws Damage.
void decodeClusters(ByteReader& in, Page& page, PageFields* fields = nullptr);

} // namespace gnomon::hierarchy
