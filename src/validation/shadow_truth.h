// Compares the shadows of a picture with ray-traced shadows, pixel by pixel, and finds a cause for each difference.
#pragma once

#include "raytrace/ground_truth.h"
#include "render/backend.h"

namespace gnomon::validation {

/// The result of comparing a pixel's shadow with the ray-traced shadow.
enum class ShadowVerdict : std::uint8_t {
    Unasked,     // no surface, or a surface that faces away from the light
    Right,       // equal to the ray-traced result
    NearEdge,    // wrong, but within a texel footprint of an edge of the ray-traced shadow
    ContactGap,  // lit instead of dark, within 1.5 footprints of the caster or of a lit point
    Missed,      // lit instead of dark, because the caster is thinner than a texel along columns or rows
    FalseShadow, // dark instead of lit, more than a texel footprint from an edge
    Leak         // lit instead of dark, for none of these reasons
};

/// The comparison of a picture's shadows with ray-traced shadows.
struct ShadowTruth {
    raytrace::ShadowComparison shadows; // comparison of all pixels
    /// The comparison without details finer than a shadow map texel, which a map cannot show. Pixels with the result
    /// Missed are not wrong. The picture may omit the edges of casters and gaps that are thinner than a texel, and
    /// contact shadows, whose caster is within 1.5 footprints. If the picture shows such an edge, its position is
    /// measured like all others. The log columns for wrong pixels and edge distances use this comparison.
    raytrace::ShadowComparison answerable;
    std::vector<ShadowVerdict> verdicts; // rows from top to bottom
    std::uint64_t missedPixels = 0;
    /// `judgedPixels` counts pixels with N.L above 0.1, where the depth bias covers the whole slope.
    /// `unexplainedPixels` counts those with the result FalseShadow or Leak.
    std::uint64_t judgedPixels = 0;
    std::uint64_t unexplainedPixels = 0;

    double missedFraction() const;      // missed pixels divided by lit-side pixels
    double unexplainedFraction() const; // unexplained pixels divided by judged pixels
};

/// Compares the shadows in the picture of `frame` with `light`, the ray-traced results for `scene`. `surfaces` are the
/// visible surfaces of the picture.
ShadowTruth shadowTruth(
    const raytrace::Scene& scene,
    const render::DrawInputs& frame,
    const render::Raster<render::SurfaceSample>& surfaces,
    std::span<const raytrace::Light> light);

} // namespace gnomon::validation
