// Clusters from bytes by the words of the format, number by number: slow, and obviously right.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/page.h"

namespace gnomon::hierarchy {

/// As decodeClusters.
void plainlyDecodeClusters(ByteReader& in, Page& page);

} // namespace gnomon::hierarchy
