// Repair of the checksums of a .gnm, so that the fuzzer reaches the code behind them. A checksum is not a signature.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::fuzz {

/// Returns `bytes` with correct checksums, and with places and sizes of the tables that tile the file. Returns them
/// unchanged if they are too short for header and footer.
std::vector<std::byte> resealed(std::span<const std::byte> bytes);

} // namespace gnomon::fuzz
