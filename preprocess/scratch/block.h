// A block: bytes of a scratch file that were appended at once, known by place and checksum.
#pragma once

#include "hierarchy/bytes.h"

#include <cstdint>
#include <vector>

namespace gnomon::scratch {

struct Block {
    std::uint64_t offset = 0; // of its first byte in the scratch file
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0; // xxh3-64 of its bytes
};

using Blocks = std::vector<Block>;

/// Appends `block` to `out`.
void putBlock(hierarchy::ByteWriter& out, const Block& block);

/// Returns the block that `putBlock` put. Throws hierarchy::Damage.
Block takeBlock(hierarchy::ByteReader& in);

} // namespace gnomon::scratch
