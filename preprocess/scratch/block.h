// The blocks of scratch files.
#pragma once

#include "hierarchy/bytes.h"

#include <cstdint>
#include <vector>

namespace gnomon::scratch {

/// A block of a scratch file: bytes that were appended at once, identified by offset and checksum.
struct Block {
    std::uint64_t offset = 0; // offset of the first byte in the scratch file
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0; // xxh3-64 of the bytes
};

using Blocks = std::vector<Block>;

/// Appends `block` to `out`.
void putBlock(hierarchy::ByteWriter& out, const Block& block);

/// Reads a block that `putBlock` wrote. Throws hierarchy::Damage if the bytes are malformed.
Block takeBlock(hierarchy::ByteReader& in);

} // namespace gnomon::scratch
