// A ring buffer in mapped GPU memory. The CPU fills one part while the GPU reads the earlier parts.
#pragma once

#include "gl/objects.h"

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::gl {

/// A piece of the ring buffer, reserved by `take`: its byte offset in the buffer, and its mapped memory.
struct RingPiece {
    std::size_t offset = 0;
    std::span<std::byte> bytes;
};

/// A ring buffer that is persistently and coherently mapped. Its three segments are filled in turn. Segment k is reused
/// when the GPU has finished all commands that were issued before segment k + 1 was full. A command that reads a piece
/// of segment k must therefore be issued before segment k + 1 is full.
class MappedRing {
public:
    MappedRing(const Api& api, std::size_t segmentBytes);
    ~MappedRing();
    MappedRing(const MappedRing&) = delete;
    MappedRing& operator=(const MappedRing&) = delete;
    MappedRing(MappedRing&&) = delete;
    MappedRing& operator=(MappedRing&&) = delete;

    /// Reserves `bytes` bytes of the ring buffer, at most the size of a segment. The offset is a multiple of
    /// `kAlignment`. Waits for the GPU only if the GPU is two segments behind.
    RingPiece take(std::size_t bytes);

    /// Returns how many bytes of a segment a piece of `bytes` bytes occupies after alignment.
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
    // One fence per segment of the ring buffer. The GPU signals it after all commands that were issued before the
    // segment was full.
    std::array<GLsync, kSegments> left_ = {};
};

} // namespace gnomon::gl
