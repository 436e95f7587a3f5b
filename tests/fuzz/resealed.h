// Mends the checksums of a .gnm, so that what lies behind them is read: a checksum is no signature.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::fuzz {

/// `bytes` with every checksum as their content has it, and places and sizes of the tables made to tile the file where
/// they do not; as they are where there is no room for header and footer.
std::vector<std::byte> resealed(std::span<const std::byte> bytes);

} // namespace gnomon::fuzz
