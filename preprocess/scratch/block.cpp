#include "preprocess/scratch/block.h"

namespace gnomon::scratch {

void putBlock(hierarchy::ByteWriter& out, const Block& block) {
    out.putVarint(block.offset);
    out.putVarint(block.bytes);
    out.put(block.checksum);
}

Block takeBlock(hierarchy::ByteReader& in) {
    Block block;
    block.offset = in.takeVarint();
    block.bytes = in.takeVarint();
    block.checksum = in.take<std::uint64_t>();
    return block;
}

} // namespace gnomon::scratch
