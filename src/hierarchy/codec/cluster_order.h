// Sorts the triangles, corners and vertices within each cluster of a page so that their encoding is short.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Sorts the triangles, their corners and the vertices within each cluster of `page`. If possible, each triangle then
/// shares an open edge with an earlier triangle. Vertices are in the order of their first use. The surface and the
/// winding of triangles do not change. The result is identical on all platforms. `fields` are sorted with the vertices.
/// Must be called before encodePage. The ranges of clusters must have no gaps or overlaps, and corners must be in
/// range.
void orderForCoding(Page& page, PageFields& fields);

/// Sorts the triangles, corners and vertices of a page whose vertices have no fields.
inline void orderForCoding(Page& page) {
    PageFields none;
    orderForCoding(page, none);
}

} // namespace gnomon::hierarchy
