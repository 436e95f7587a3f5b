// Reads a file sequentially in large blocks and gives a parser a contiguous window of bytes in memory.
#pragma once

#include "preprocess/read/input_file.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::read {

/// A window of bytes that moves forward through a file. It buffers at most kBufferBytes for a file of any size.
class ByteStream {
public:
    static constexpr std::size_t kBufferBytes = std::size_t{2} << 20U;

    ByteStream(const InputFile& file, std::uint64_t offset);

    /// Returns the file's bytes from the current position on. The first available() bytes are in memory.
    const std::byte* data() const { return buffer_.data() + begin_; }

    std::size_t available() const { return end_ - begin_; }

    /// Reads the file until at least `count` bytes (at most kBufferBytes) are in memory. Returns false if the file ends
    /// before.
    bool fill(std::size_t count) { return available() >= count || refill(count); }

    /// Moves the current position forward by `count` bytes, which must be in memory already.
    void consume(std::size_t count) { begin_ += count; }

    /// Moves the current position forward by `count` bytes (at most remaining()), without reading them from the file.
    void skip(std::uint64_t count);

    /// Goes back to the start of the file.
    void rewind() { bufferOffset_ = begin_ = end_ = 0; }

    /// Returns the current position in bytes from the start of the file.
    std::uint64_t offset() const { return bufferOffset_ + begin_; }

    /// Returns the number of bytes from the current position to the end of the file.
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
