// A ring buffer in mapped memory: the CPU fills one part while the GPU reads the earlier parts.
#pragma once

#include "gl/objects.h"

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::gl {

/// A part of the ring that `take` returns: its byte offset in the buffer, and its mapped memory.
struct RingPiece {
    std::size_t offset = 0;
    std::span<std::byte> bytes;
};

/// A persistently and coherently mapped buffer with three segments, which are filled in turn. Segment k is reused when
/// the GPU has finished all commands that were issued before segment k + 1 was full. A command that reads a piece of
/// segment k must therefore be issued before segment k + 1 is full.
class MappedRing {
public:
    MappedRing(const Api& api, std::size_t segmentBytes);
    ~MappedRing();
    MappedRing(const MappedRing&) = delete;
    MappedRing& operator=(const MappedRing&) = delete;
    MappedRing(MappedRing&&) = delete;
    MappedRing& operator=(MappedRing&&) = delete;

    /// Returns a piece of `bytes` bytes, at most the size of a segment. Its offset is a multiple of `kAlignment`. Waits
    /// for the GPU only if the GPU is two segments behind.
    RingPiece take(std::size_t bytes);

    /// Returns the space in a segment that a piece of `bytes` bytes uses.
    static constexpr std::size_t aligned(std::size_t bytes) {
        return (bytes + kAlignment - 1) / kAlignment * kAlignment;
    }

    GLuint id() const { return object_.id(); }

    std::size_t segmentBytes() const { return segmentBytes_; }

    std::size_t size() const { return kSegments * segmentBytes_; }

private:
    static constexpr std::size_t kSegments = 3;
    static constexpr std::size_t kAlignment = 256; // max alignment that OpenGL can require for a uniform block

    void enterNext();

    const Api* api_;
    std::size_t segmentBytes_;
    Object object_;
    std::byte* memory_ = nullptr;
    std::size_t segment_ = 0;
    std::size_t used_ = 0; // bytes used in the current segment
    // One fence per segment. The GPU signals it after all commands that were issued before the segment was full.
    std::array<GLsync, kSegments> left_ = {};
};

} // namespace gnomon::gl
