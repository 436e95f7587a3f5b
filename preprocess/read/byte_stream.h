// Sequential reading of a file in big blocks, with a window of contiguous bytes to parse from.
#pragma once

#include "preprocess/read/input_file.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::read {

/// A forward window over a file. Holds one buffer of at most kBufferBytes, whatever the file's size.
class ByteStream {
public:
    static constexpr std::size_t kBufferBytes = std::size_t{2} << 20U;

    ByteStream(const InputFile& file, std::uint64_t offset);

    /// The bytes at the current place that are in memory.
    const std::byte* data() const { return buffer_.data() + begin_; }

    std::size_t available() const { return end_ - begin_; }

    /// Makes at least `count` bytes available (at most kBufferBytes); false if the file ends before.
    bool fill(std::size_t count) { return available() >= count || refill(count); }

    /// Passes over `count` available bytes.
    void consume(std::size_t count) { begin_ += count; }

    /// Passes over `count` bytes without reading what is not yet in memory; `count` at most remaining().
    void skip(std::uint64_t count);

    /// Goes back to the start of the file.
    void rewind() { bufferOffset_ = begin_ = end_ = 0; }

    /// The current place in bytes from the start of the file.
    std::uint64_t offset() const { return bufferOffset_ + begin_; }

    /// Bytes from the current place to the end of the file.
    std::uint64_t remaining() const { return fileBytes_ - offset(); }

    const std::string& path() const { return file_.path(); }

private:
    bool refill(std::size_t count);

    const InputFile& file_;
    std::uint64_t fileBytes_;
    std::vector<std::byte> buffer_;
    std::uint64_t bufferOffset_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

} // namespace gnomon::read
