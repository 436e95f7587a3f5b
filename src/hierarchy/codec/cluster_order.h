// The order of triangles, corners and vertices within a cluster that makes its encoding short.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Reorders the triangles, their corners and the vertices within each cluster of `page`. Each triangle then follows
/// across an edge that is still open, and vertices are in the order of their first use. The surface and the winding
/// stay the same. The result is identical on all platforms. `fields` are reordered with the vertices. Call this before
/// encodePage. Ranges must tile and corners must be in range.
void orderForCoding(Page& page, PageFields& fields);

/// Reorders a page whose vertices have no fields.
inline void orderForCoding(Page& page) {
    PageFields none;
    orderForCoding(page, none);
}

} // namespace gnomon::hierarchy
