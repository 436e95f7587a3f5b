#include "preprocess/scratch/stream_store.h"

#include "core/check.h"
#include "hierarchy/bytes.h"

#include <algorithm>

namespace gnomon::scratch {

StreamStore::StreamStore(ScratchFile& file, std::uint32_t streamCount, std::size_t blockBytes)
    : file_(file), blockBytes_(blockBytes), streams_(streamCount) {}

StreamStore::StreamStore(ScratchFile& file, std::span<const std::byte> directory) : file_(file), blockBytes_(1) {
    std::vector<Blocks> blocks = blocksOf(directory);
    streams_.resize(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i)
        streams_[i].blocks = std::move(blocks[i]);
}

std::vector<Blocks> StreamStore::blocksOf(std::span<const std::byte> directory) {
    hierarchy::ByteReader in(directory);
    const auto count = [&in] {
        const std::uint64_t values = in.takeVarint();
        // Each value has at least one byte, so a larger count means damaged bytes.
        if (values > in.remaining()) throw hierarchy::Damage{"the bytes end too early"};
        return values;
    };
    std::vector<Blocks> streams(count());
    for (Blocks& stream : streams) {
        stream.resize(count());
        for (Block& block : stream)
            block = takeBlock(in);
    }
    in.expectEnd();
    return streams;
}

void StreamStore::append(std::uint32_t stream, std::span<const std::byte> bytes) {
    std::vector<std::byte>& open = streams_[stream].open;
    if (open.size() + bytes.size() > blockBytes_) writeOpen(streams_[stream]);
    if (bytes.size() > blockBytes_) return write(streams_[stream], bytes);
    // The buffer of a stream grows step by step, so that a short stream does not allocate a whole block.
    if (open.capacity() < open.size() + bytes.size())
        open.reserve(std::max(open.size() + bytes.size(), std::min(blockBytes_, 2 * open.capacity() + 256)));
    open.insert(open.end(), bytes.begin(), bytes.end());
}

void StreamStore::writeOpen(Stream& stream) {
    if (stream.open.empty()) return;
    write(stream, stream.open);
    stream.open.clear();
}

void StreamStore::write(Stream& stream, std::span<const std::byte> bytes) {
    stream.blocks.push_back(file_.append(bytes));
}

void StreamStore::flush() {
    for (Stream& stream : streams_) {
        writeOpen(stream);
        stream.open = {};
    }
}

std::uint64_t StreamStore::bytes(std::uint32_t stream) const {
    std::uint64_t sum = streams_[stream].open.size();
    for (const Block& block : streams_[stream].blocks)
        sum += block.bytes;
    return sum;
}

std::vector<std::byte> StreamStore::read(std::uint32_t stream) const {
    std::vector<std::byte> all(bytes(stream));
    readInto(stream, all);
    return all;
}

void StreamStore::readInto(std::uint32_t stream, std::span<std::byte> out) const {
    GNOMON_CHECK_OP(out.size(), ==, bytes(stream));
    std::size_t done = 0;
    for (const Block& block : streams_[stream].blocks) {
        file_.read(block, out.subspan(done, block.bytes));
        done += block.bytes;
    }
}

bool StreamStore::Reader::isAtEnd() {
    const Blocks& blocks = store_.streams_[stream_].blocks;
    while (place_ == block_.size() && nextBlock_ < blocks.size()) {
        block_.resize(blocks[nextBlock_].bytes);
        store_.file_.read(blocks[nextBlock_], block_);
        ++nextBlock_;
        place_ = 0;
    }
    return place_ == block_.size();
}

void StreamStore::Reader::takeBytes(std::span<std::byte> out) {
    while (!out.empty()) {
        GNOMON_CHECK(!isAtEnd());
        const std::size_t count = std::min(out.size(), block_.size() - place_);
        std::memcpy(out.data(), block_.data() + place_, count);
        out = out.subspan(count);
        place_ += count;
    }
}

void StreamStore::release(std::uint32_t stream) {
    for (const Block& block : takeBlocks(stream))
        file_.release(block);
}

std::vector<std::byte> StreamStore::directory() const {
    hierarchy::ByteWriter out;
    out.putVarint(streams_.size());
    for (const Stream& stream : streams_) {
        out.putVarint(stream.blocks.size());
        for (const Block& block : stream.blocks)
            putBlock(out, block);
    }
    return out.take();
}

} // namespace gnomon::scratch
