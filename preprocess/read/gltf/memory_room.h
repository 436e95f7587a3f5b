// The memory budget for reading a whole file into memory.
#pragma once

#include "core/error.h"
#include "core/units.h"

#include <string>

namespace gnomon::read {

/// Counts memory against a limit before the memory is allocated. This is necessary because a file of a few bytes can
/// declare any number of values.
class MemoryRoom {
public:
    MemoryRoom(std::string path, Bytes limit) : path_(std::move(path)), limit_(limit) {}

    /// Reserves memory for `count` values of `bytes` bytes each. Throws Error, which names the file, if the total would
    /// exceed the limit.
    void take(std::uint64_t count, std::uint64_t bytes = 1) {
        if (bytes == 0 || count <= (limit_.count - taken_) / bytes) {
            taken_ += count * bytes;
            return;
        }
        throw Error(
            path_,
            "too large: this format is read into memory as a whole; convert the file to PLY, which is streamed",
            "at most " + readableBytes(limit_) + " of memory",
            "a need for " + std::to_string(count) + " values of " + std::to_string(bytes) + " bytes besides " +
                readableBytes({taken_}));
    }

    /// Releases `bytes` bytes of the memory that was reserved.
    void give(std::uint64_t bytes) { taken_ -= bytes; }

    Bytes taken() const { return {taken_}; }

    Bytes limit() const { return limit_; }

private:
    std::string path_;
    Bytes limit_;
    std::uint64_t taken_ = 0; // reserved bytes, at most the limit
};

} // namespace gnomon::read
