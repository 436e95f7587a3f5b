// A simple decoder of clusters that follows the format description number by number, as reference for the fast one.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

namespace gnomon::hierarchy {

/// Decodes the same data as decodeClusters.
void plainlyDecodeClusters(ByteReader& in, Page& page);

} // namespace gnomon::hierarchy
