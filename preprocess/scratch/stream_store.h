// Stores many byte streams in blocks of one scratch file. The streams grow at the same time and are read one by one.
#pragma once

#include "preprocess/scratch/scratch_file.h"

#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::scratch {

/// Decodes `bytes` as values of type T, and calls `take(value)` for each value in order. The size of `bytes` must be a
/// multiple of sizeof(T).
template <class T, class Take>
void forEachRecord(std::span<const std::byte> bytes, const Take& take) {
    static_assert(std::is_trivially_copyable_v<T>);
    for (std::size_t place = 0; place < bytes.size(); place += sizeof(T)) {
        T value{};
        std::memcpy(&value, bytes.data() + place, sizeof(T));
        take(value);
    }
}

/// A set of append-only byte streams, numbered from 0, in one scratch file. A stream returns its bytes in the order in
/// which they were appended. This order does not depend on the block size.
class StreamStore {
public:
    /// Creates `streamCount` empty streams. Each stream buffers up to `blockBytes` bytes in memory. `flush` writes the
    /// buffers to the scratch file.
    StreamStore(ScratchFile& file, std::uint32_t streamCount, std::size_t blockBytes);

    /// Restores the streams from the bytes that `directory()` returned in an earlier process.
    StreamStore(ScratchFile& file, std::span<const std::byte> directory);

    /// Appends `bytes` to the stream with the number `stream`.
    void append(std::uint32_t stream, std::span<const std::byte> bytes);

    template <class T>
    void put(std::uint32_t stream, const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(stream, std::as_bytes(std::span(&value, 1)));
    }

    /// Writes the buffered bytes of all streams to the scratch file and frees the buffers.
    void flush();

    /// Appends a block to a stream. Another process has already written the block to the scratch file. If the stream
    /// has buffered bytes, the caller must call `flush` first.
    void adopt(std::uint32_t stream, const Block& block) { streams_[stream].blocks.push_back(block); }

    const Blocks& blocks(std::uint32_t stream) const { return streams_[stream].blocks; }

    std::uint32_t streamCount() const { return static_cast<std::uint32_t>(streams_.size()); }

    std::uint64_t bytes(std::uint32_t stream) const;

    /// Returns all bytes of a stream. After `flush`, many threads can call this function at once.
    std::vector<std::byte> read(std::uint32_t stream) const;

    /// Returns all values of a stream that contains values of type T.
    template <class T>
    std::vector<T> readAs(std::uint32_t stream) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> values(bytes(stream) / sizeof(T));
        readInto(stream, std::as_writable_bytes(std::span(values)));
        return values;
    }

    /// Calls `take(bytes)` for each block of a stream, in order. All bytes of one `append` are in one block. After
    /// `flush`, many threads can call this function at once.
    template <class Take>
    void readBlocks(std::uint32_t stream, const Take& take) const {
        std::vector<std::byte> bytes;
        for (const Block& block : streams_[stream].blocks) {
            bytes.resize(block.bytes);
            file_.read(block, bytes);
            take(std::span<const std::byte>(bytes));
        }
    }

    /// Reads the values of one stream one after the other, with one block in memory. Other streams may grow during the
    /// reading.
    class Reader {
    public:
        Reader(const StreamStore& store, std::uint32_t stream) : store_(store), stream_(stream) {}

        bool isAtEnd();

        /// Reads the next value of the stream. An assertion fails at the end of the stream.
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

    /// Removes all blocks from a stream and returns them. The caller must free the space of these blocks.
    Blocks takeBlocks(std::uint32_t stream) { return std::exchange(streams_[stream].blocks, {}); }

    /// Frees the space of a stream's blocks.
    void release(std::uint32_t stream);

    /// Returns the block lists of all streams, encoded as bytes. Another process can restore the streams from them. The
    /// caller must call `flush` before.
    std::vector<std::byte> directory() const;

    /// Decodes the block list of each stream from the bytes that `directory()` returned. Throws hierarchy::Damage if
    /// the bytes are malformed.
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
