// Orders the triangles, corners and vertices within each cluster of a page so that their encoding is short.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Reorders the triangles, their corners and the vertices within each cluster of `page`. Each triangle then continues
/// across an edge that is still open, and vertices are in the order of their first use. The surface and the winding of
/// triangles do not change. The result is identical on all platforms. `fields` are reordered with the vertices. Call
/// this before encodePage. The ranges of clusters must have no gaps or overlaps, and corners must be in range.
void orderForCoding(Page& page, PageFields& fields);

/// Reorders a page whose vertices have no fields, as above.
inline void orderForCoding(Page& page) {
    PageFields none;
    orderForCoding(page, none);
}

} // namespace gnomon::hierarchy
