// How far shadows crawl as the camera moves: fixed points of the world, looked up in two frames after one another.
#pragma once

#include "executor/executor.h"

namespace gnomon::proof {

/// A frame and the depth texture that it drew; both must outlive it.
struct DrawnMaps {
    const executor::FrameDrawing* frame = nullptr;
    const executor::FloatPicture* depth = nullptr;
};

/// Points that two frames look up in the same slice (and face), and those of them whose result differs.
struct Crawl {
    std::uint64_t points = 0;
    std::uint64_t changed = 0;

    /// 0 without points.
    double share() const { return points == 0 ? 0 : static_cast<double>(changed) / static_cast<double>(points); }
};

/// Looks up both frames' maps at the lit-side points that `before` shows as `surfaces` and that lie in the view of
/// `now`, on all cores.
Crawl crawl(const DrawnMaps& before, const executor::Raster<executor::SurfaceSample>& surfaces, const DrawnMaps& now);

} // namespace gnomon::proof
