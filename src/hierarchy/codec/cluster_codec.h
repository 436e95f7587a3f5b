// The codec of the clusters of a page: an edge code for the triangles, and differences from a prediction for the
// vertices.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Encodes vertices and triangles of all clusters of `page`, and the `fields` of the vertices. The encoding is lossless
/// for each valid page, and short for a page in the order of orderForCoding. Returns the offsets in `out` at which
/// bytes of one kind end, because compressors do better with each kind on its own. The last offset is the end.
std::vector<std::size_t> encodeClusters(const Page& page, ByteWriter& out, const PageFields& fields = {});

/// Decodes `page.vertices`, `page.triangles` and the boxes of `page.clusters`, and `fields` if it is not null. The
/// ranges of the clusters must be filled and must tile. Throws Damage if the bytes are invalid.
void decodeClusters(ByteReader& in, Page& page, PageFields* fields = nullptr);

} // namespace gnomon::hierarchy
