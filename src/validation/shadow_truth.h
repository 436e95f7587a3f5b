// Comparison of a picture's shadows with ray-traced shadows, pixel by pixel, with a cause for each difference.
#pragma once

#include "raytrace/ground_truth.h"
#include "render/backend.h"

namespace gnomon::validation {

/// The result of the comparison at a pixel.
enum class ShadowVerdict : std::uint8_t {
    Unasked,     // no surface, or a surface that faces away from the light
    Right,       // equal to the ray-traced result
    NearEdge,    // wrong, but within a texel's footprint of an edge of the true shadow
    ContactGap,  // lit instead of dark, within 1.5 footprints of the caster or of a lit point
    Missed,      // lit instead of dark, because the caster is thinner than a texel along columns or rows
    FalseShadow, // dark instead of lit, farther from an edge
    Leak         // lit instead of dark, without one of these causes
};

/// The comparison of a picture's shadows with ray-traced shadows.
struct ShadowTruth {
    raytrace::ShadowComparison shadows; // over all pixels
    /// The comparison without details finer than a texel, which a map cannot represent. Pixels of missed casters are
    /// not wrong. The edges of casters and gaps thinner than a texel may be absent, and so may contact shadows, whose
    /// caster is within 1.5 footprints. If such an edge is drawn, its position is measured like that of all others. The
    /// columns of wrong shadows and edge distances use this comparison.
    raytrace::ShadowComparison answerable;
    std::vector<ShadowVerdict> verdicts; // rows from top to bottom
    std::uint64_t missedPixels = 0;
    /// Lit-side pixels with N.L above 0.1, where the bias is not capped, and the false shadows and leaks among them.
    std::uint64_t judgedPixels = 0;
    std::uint64_t unexplainedPixels = 0;

    double missedFraction() const;      // share of the lit-side pixels
    double unexplainedFraction() const; // share of the judged pixels
};

/// Compares the shadows of the picture of `frame` that shows `surfaces` with `light`, the ray-traced result in `scene`.
ShadowTruth shadowTruth(
    const raytrace::Scene& scene,
    const render::DrawInputs& frame,
    const render::Raster<render::SurfaceSample>& surfaces,
    std::span<const raytrace::Light> light);

} // namespace gnomon::validation
