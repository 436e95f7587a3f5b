// Reads the vertices of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/page.h"

namespace gnomon::hierarchy {

/// Fills `page.vertices`, which has its size, and the boxes of `page.clusters` from what `in` has next. `edges` is what
/// decodeConnectivity found. Throws Damage.
void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page);

} // namespace gnomon::hierarchy
