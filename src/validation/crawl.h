// Measures shadow crawl (swimming) during camera motion: looks up the same world points in the shadow maps of two
// successive frames, and compares the results.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// A frame and the depth texture of its shadow maps. Both must outlive this object.
struct DrawnMaps {
    const render::DrawInputs* frame = nullptr;
    const render::FloatPicture* depth = nullptr;
};

/// The number of points that both frames look up in the same slice and face, and the number of these points whose
/// shadow differs.
struct Crawl {
    std::uint64_t points = 0;
    std::uint64_t changed = 0;

    /// Returns the fraction of points whose shadow changed, or 0 without points.
    double share() const { return points == 0 ? 0 : static_cast<double>(changed) / static_cast<double>(points); }
};

/// Looks up points in the shadow maps of both frames and compares the results, on all cores. The points are the visible
/// surfaces `surfaces` of `before` that face the light and are in the view of `now`.
Crawl crawl(const DrawnMaps& before, const render::Raster<render::SurfaceSample>& surfaces, const DrawnMaps& now);

} // namespace gnomon::validation
