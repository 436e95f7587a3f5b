#include "preprocess/read/byte_stream.h"

#include "core/check.h"

#include <algorithm>
#include <cstring>

namespace gnomon::read {

ByteStream::ByteStream(const InputFile& file, std::uint64_t offset)
    : file_(file),
      fileBytes_(file.size()),
      buffer_(std::min<std::uint64_t>(fileBytes_, kBufferBytes)),
      bufferOffset_(offset) {
    GNOMON_CHECK_OP(offset, <=, fileBytes_);
}

void ByteStream::skip(std::uint64_t count) {
    GNOMON_CHECK_OP(count, <=, remaining());
    const std::size_t inMemory = static_cast<std::size_t>(std::min<std::uint64_t>(count, available()));
    begin_ += inMemory;
    if (inMemory == count) return;
    bufferOffset_ = offset() + (count - inMemory);
    begin_ = end_ = 0;
}

bool ByteStream::refill(std::size_t count) {
    GNOMON_CHECK_OP(count, <=, kBufferBytes);
    if (bufferOffset_ + end_ >= fileBytes_) return false;
    std::memmove(buffer_.data(), data(), available());
    bufferOffset_ += begin_;
    end_ -= begin_;
    begin_ = 0;
    end_ += file_.readSomeAt(bufferOffset_ + end_, std::span(buffer_).subspan(end_));
    return end_ >= count;
}

} // namespace gnomon::read
