// Many streams of bytes that grow side by side and are read one by one, kept in blocks of one scratch file.
#pragma once

#include "preprocess/scratch/scratch_file.h"

#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::scratch {

/// Calls `take` for one value of `bytes`, which has a whole number of them, after the other.
template <class T, class Take>
void forEachRecord(std::span<const std::byte> bytes, const Take& take) {
    static_assert(std::is_trivially_copyable_v<T>);
    for (std::size_t place = 0; place < bytes.size(); place += sizeof(T)) {
        T value{};
        std::memcpy(&value, bytes.data() + place, sizeof(T));
        take(value);
    }
}

/// Streams count from 0. What comes out of a stream is what went in, in order, whatever the size of the blocks.
class StreamStore {
public:
    /// Each stream that is in use holds up to `blockBytes` in memory until the next `flush`.
    StreamStore(ScratchFile& file, std::uint32_t streamCount, std::size_t blockBytes);

    /// As left by an earlier process, from its `directory`.
    StreamStore(ScratchFile& file, std::span<const std::byte> directory);

    void append(std::uint32_t stream, std::span<const std::byte> bytes);

    template <class T>
    void put(std::uint32_t stream, const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(stream, std::as_bytes(std::span(&value, 1)));
    }

    /// Writes what is in memory and frees it.
    void flush();

    /// Appends what somebody else has written to the scratch file; what was appended before must be flushed.
    void adopt(std::uint32_t stream, const Block& block) { streams_[stream].blocks.push_back(block); }

    const Blocks& blocks(std::uint32_t stream) const { return streams_[stream].blocks; }

    std::uint32_t streamCount() const { return static_cast<std::uint32_t>(streams_.size()); }

    std::uint64_t bytes(std::uint32_t stream) const;

    /// All of a stream; safe from many threads once flushed.
    std::vector<std::byte> read(std::uint32_t stream) const;

    /// All of a stream as values of one type.
    template <class T>
    std::vector<T> readAs(std::uint32_t stream) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(bytes(stream) / sizeof(T));
        readInto(stream, std::as_writable_bytes(std::span(values)));
        return values;
    }

    /// Calls `take(bytes)` for one block of a stream after the other; what was appended at once is in one block. Safe
    /// from many threads once flushed.
    template <class Take>
    void readBlocks(std::uint32_t stream, const Take& take) const {
        std::vector<std::byte> bytes;
        for (const Block& block : streams_[stream].blocks) {
            bytes.resize(block.bytes);
            file_.read(block, bytes);
            take(std::span<const std::byte>(bytes));
        }
    }

    /// Reads a stream from its start in the memory of a block, while others may be appended to.
    class Reader {
    public:
        Reader(const StreamStore& store, std::uint32_t stream) : store_(store), stream_(stream) {}

        bool isAtEnd();

        /// The next value; a check fails at the end.
        template <class T>
        T take() {
            T value{};
            takeBytes(std::as_writable_bytes(std::span(&value, 1)));
            return value;
        }

    private:
        void takeBytes(std::span<std::byte> out);

        const StreamStore& store_;
        std::uint32_t stream_;
        std::size_t nextBlock_ = 0;
        std::vector<std::byte> block_;
        std::size_t place_ = 0;
    };

    /// Empties a stream and returns its blocks, whose space the caller gives back.
    Blocks takeBlocks(std::uint32_t stream) { return std::exchange(streams_[stream].blocks, {}); }

    /// Gives a stream's space back.
    void release(std::uint32_t stream);

    /// Where everything lies, for another process; after `flush`.
    std::vector<std::byte> directory() const;

    /// The blocks of each stream of a `directory`. Throws hierarchy::Damage.
    static std::vector<Blocks> blocksOf(std::span<const std::byte> directory);

private:
    struct Stream {
        std::vector<std::byte> open;
        Blocks blocks;
    };

    void writeOpen(Stream& stream);
    void write(Stream& stream, std::span<const std::byte> bytes);
    void readInto(std::uint32_t stream, std::span<std::byte> out) const;

    ScratchFile& file_;
    std::size_t blockBytes_;
    std::vector<Stream> streams_;
};

} // namespace gnomon::scratch
