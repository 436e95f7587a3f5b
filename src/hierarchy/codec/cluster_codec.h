// Encodes and decodes the clusters of a page. Triangles are stored as codes of shared edges, and vertices as
// differences from a prediction.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Encodes the vertices and triangles of all clusters of `page`, and the `fields` of the vertices. The encoding is
/// lossless for each valid page. It is shortest if orderForCoding has sorted the page. Returns the offsets in `out` at
/// which bytes of one kind end, because compressors work better on each kind separately. The last offset is the end of
/// all bytes.
std::vector<std::size_t> encodeClusters(const Page& page, ByteWriter& out, const PageFields& fields = {});

/// Decodes the vertices and triangles of all clusters of `page`, the boxes of the clusters, and `fields` if it is not
/// null. The caller must have set the vertex and triangle ranges of the clusters, which must have no gaps or overlaps.
/// Throws Damage if the bytes are invalid.
void decodeClusters(ByteReader& in, Page& page, PageFields* fields = nullptr);

} // namespace gnomon::hierarchy
