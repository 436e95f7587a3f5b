#include "frame/accumulation.h"

#include <cmath>

namespace gnomon::frame {

namespace {

/// `place` 2^32ths, around, in [-1/2, 1/2).
double aroundMiddle(std::uint32_t place) {
    return std::ldexp(static_cast<double>(static_cast<std::int32_t>(place)), -32);
}

} // namespace

glm::dvec2 subpixelOffset(int sample) {
    // The directions of both dimensions: those of van der Corput, and of the polynomial x + 1.
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t directionX = std::uint32_t{1} << 31U;
    std::uint32_t directionY = directionX;
    for (auto bits = static_cast<std::uint32_t>(sample); bits != 0; bits >>= 1U) {
        if ((bits & 1U) != 0) {
            x ^= directionX;
            y ^= directionY;
        }
        directionX >>= 1U;
        directionY ^= directionY >> 1U;
    }
    return {aroundMiddle(x), aroundMiddle(y)};
}

void Accumulation::begin(Renderer& renderer, const Frame& frame, bool keepsCoverage) {
    renderer_ = &renderer;
    frame_ = &frame;
    keepsCoverage_ = keepsCoverage;
    sum_.reset();
    take();
}

void Accumulation::add() {
    FrameOptions options = frame_->options;
    options.subpixel = subpixelOffset(samples());
    renderer_->drawSample(*frame_, options);
    take();
}

void Accumulation::take() {
    executor::Executor& executor = renderer_->executor();
    std::optional<executor::Coverage> coverage;
    if (keepsCoverage_) coverage = executor::coverageOf(executor.viewDepth());
    sum_.add(executor.picture(), coverage);
}

} // namespace gnomon::frame
