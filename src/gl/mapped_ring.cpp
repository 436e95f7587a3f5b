#include "gl/mapped_ring.h"

#include "core/check.h"
#include "core/error.h"
#include "core/units.h"

namespace gnomon::gl {

namespace {

constexpr GLbitfield kMapped = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

} // namespace

MappedRing::MappedRing(const Api& api, std::size_t segmentBytes) : api_(&api), segmentBytes_(aligned(segmentBytes)) {
    GLuint name = 0;
    api.createBuffers(1, &name);
    object_ = {name, api.deleteBuffers};
    const auto bytes = static_cast<GLsizeiptr>(size());
    api.namedBufferStorage(name, bytes, nullptr, kMapped);
    memory_ = static_cast<std::byte*>(api.mapNamedBufferRange(name, 0, bytes, kMapped));
    if (memory_ == nullptr) throw Error("OpenGL", "a buffer cannot be mapped", readableBytes({size()}), "nothing");
}

MappedRing::~MappedRing() {
    for (GLsync fence : left_)
        if (fence != nullptr) api_->deleteSync(fence);
}

RingPiece MappedRing::take(std::size_t bytes) {
    GNOMON_CHECK_OP(bytes, <=, segmentBytes_);
    if (aligned(bytes) > segmentBytes_ - used_) enterNext();
    const RingPiece piece{segment_ * segmentBytes_ + used_, {memory_ + segment_ * segmentBytes_ + used_, bytes}};
    used_ += aligned(bytes);
    return piece;
}

void MappedRing::enterNext() {
    if (left_[segment_] != nullptr) api_->deleteSync(left_[segment_]);
    left_[segment_] = api_->fenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    segment_ = (segment_ + 1) % kSegments;
    used_ = 0;
    // Waits until the GPU has passed the fence of the next segment in the ring. The fence was issued when that segment
    // was full. All commands that read the segment were issued before this fence.
    const GLsync fence = left_[(segment_ + 1) % kSegments];
    constexpr GLuint64 kNanoseconds = 1'000'000'000;
    if (fence == nullptr) return;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
        status = api_->clientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kNanoseconds);
    if (status == GL_WAIT_FAILED) throw Error("OpenGL", "waiting for the GPU failed", "a fence", "an error");
}

} // namespace gnomon::gl
