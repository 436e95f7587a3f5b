// Decodes the vertices of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Decodes the vertices of `page` and the boxes of its clusters from `in`. `edges` is the result of decodeConnectivity.
/// If the page stores fields, `fields` must not be null and receives them. Throws Damage if the bytes are invalid.
void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page, PageFields* fields);

} // namespace gnomon::hierarchy
