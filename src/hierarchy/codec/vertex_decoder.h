// Reads the vertices of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Fills `page.vertices`, which has its size, and the boxes of `page.clusters` from what `in` has next. `edges` is what
/// decodeConnectivity found. Where `fields` are stored, which is so if there is any, they are filled too. Throws
/// Damage.
void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page, PageFields* fields);

} // namespace gnomon::hierarchy
