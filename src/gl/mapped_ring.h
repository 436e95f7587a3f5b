// Memory that the program fills while the GPU still reads what was put there before.
#pragma once

#include "gl/objects.h"

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::gl {

/// A piece of a ring: its place in the buffer, and the memory to fill.
struct RingPiece {
    std::size_t offset = 0;
    std::span<std::byte> bytes;
};

/// A persistently and coherently mapped buffer of three segments that are filled in turn. A segment is written again
/// once the GPU has finished whatever was issued before the segment behind it was full: so a command that reads a piece
/// may be issued after that piece's segment was left, as long as it comes before the next one is.
class MappedRing {
public:
    MappedRing(const Api& api, std::size_t segmentBytes);
    ~MappedRing();
    MappedRing(const MappedRing&) = delete;
    MappedRing& operator=(const MappedRing&) = delete;
    MappedRing(MappedRing&&) = delete;
    MappedRing& operator=(MappedRing&&) = delete;

    /// A piece of `bytes` bytes, at most a segment, at a multiple of `kAlignment`. Waits for the GPU only if it is two
    /// segments behind.
    RingPiece take(std::size_t bytes);

    /// What a piece of `bytes` bytes takes of a segment.
    static constexpr std::size_t aligned(std::size_t bytes) {
        return (bytes + kAlignment - 1) / kAlignment * kAlignment;
    }

    GLuint id() const { return object_.id(); }

    std::size_t segmentBytes() const { return segmentBytes_; }

    std::size_t size() const { return kSegments * segmentBytes_; }

private:
    static constexpr std::size_t kSegments = 3;
    static constexpr std::size_t kAlignment = 256; // the largest that OpenGL asks of a uniform block

    void enterNext();

    const Api* api_;
    std::size_t segmentBytes_;
    Object object_;
    std::byte* memory_ = nullptr;
    std::size_t segment_ = 0;
    std::size_t used_ = 0;                    // of the segment
    std::array<GLsync, kSegments> left_ = {}; // signalled when all that was issued before the segment was left is done
};

} // namespace gnomon::gl
