// The order of triangles, corners and vertices inside a cluster that makes it short in the file.
#pragma once

#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Reorders triangles, their corners (keeping the winding) and vertices inside each cluster of `page` so that each
/// triangle follows across an edge that is still open; vertices come in the order of their first use. The surface is
/// the same and so is the result everywhere; `fields` go with the vertices. Call it before encodePage. Needs ranges
/// that tile and corners in range.
void orderForCoding(Page& page, PageFields& fields);

/// Of a page whose vertices have no fields.
inline void orderForCoding(Page& page) {
    PageFields none;
    orderForCoding(page, none);
}

} // namespace gnomon::hierarchy
