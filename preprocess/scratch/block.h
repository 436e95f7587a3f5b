// Defines a block, which is a range of bytes in a scratch file.
#pragma once

#include "hierarchy/bytes.h"

#include <cstdint>
#include <vector>

namespace gnomon::scratch {

/// A block of a scratch file: the bytes that one call appended. Its offset and its checksum identify it.
struct Block {
    std::uint64_t offset = 0; // offset of the first byte in the scratch file
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0; // xxh3-64 of the bytes
};

using Blocks = std::vector<Block>;

/// Appends the encoded offset, size and checksum of `block` to `out`.
void putBlock(hierarchy::ByteWriter& out, const Block& block);

/// Decodes a block that `putBlock` encoded. Throws hierarchy::Damage if the bytes are malformed.
Block takeBlock(hierarchy::ByteReader& in);

} // namespace gnomon::scratch
