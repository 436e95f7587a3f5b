// The decoder of the vertices of a page's clusters.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/page.h"
#include "hierarchy/page_fields.h"

namespace gnomon::hierarchy {

/// Decodes `page.vertices` and the boxes of `page.clusters` from `in`. `edges` are the result of decodeConnectivity. If
/// `fields` is not null, the page stores fields, and they are decoded too. Throws Damage if the bytes are invalid.
void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page, PageFields* fields);

} // namespace gnomon::hierarchy
