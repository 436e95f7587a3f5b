// Measurement of shadow crawl (swimming) under camera motion: fixed world points are looked up in the maps of two
// successive frames.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// A frame and the depth texture of its maps. Both must outlive this object.
struct DrawnMaps {
    const render::DrawInputs* frame = nullptr;
    const render::FloatPicture* depth = nullptr;
};

/// Counts of points that both frames look up in the same slice and face, and of points with different results.
struct Crawl {
    std::uint64_t points = 0;
    std::uint64_t changed = 0;

    /// Returns the share of changed points, or 0 without points.
    double share() const { return points == 0 ? 0 : static_cast<double>(changed) / static_cast<double>(points); }
};

/// Looks up the maps of both frames at lit-side points and compares the results, on all cores. The points are the
/// `surfaces` of `before` that are in the view of `now`.
Crawl crawl(const DrawnMaps& before, const render::Raster<render::SurfaceSample>& surfaces, const DrawnMaps& now);

} // namespace gnomon::validation
