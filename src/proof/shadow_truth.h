// How true the shadows of a picture are: held against rays, pixel by pixel, and in texels where they differ.
#pragma once

#include "executor/executor.h"
#include "raycast/shadow_oracle.h"

namespace gnomon::proof {

/// What is to be said of a pixel's shadow.
enum class ShadowVerdict : std::uint8_t {
    Unasked,     // no surface, or one turned from the light
    Right,       // as rays have it
    NearEdge,    // wrong, within a texel's footprint of an edge of the true shadow
    ContactGap,  // lit where rays see dark, within 1.5 footprints of the caster or of where the light reaches
    Missed,      // lit where rays see dark: the caster is thinner than a texel, along its columns or its rows
    FalseShadow, // dark where rays see light, further from an edge
    Leak         // lit where rays see dark, and none of these
};

/// A picture's shadows against those that rays find.
struct ShadowTruth {
    raycast::ShadowComparison shadows; // all pixels
    /// The same with what is finer than a texel counted apart, for which a map that samples once a texel may hold
    /// anything: the pixels of missed casters are not wrong; edges of casters, and of gaps between them, that are
    /// thinner than a texel, and of shadows of contact, whose caster is within 1.5 footprints, need not be drawn. Where
    /// they are drawn they have to be where they are, as all edges. The log's wrong shadows and edge distances are
    /// these.
    raycast::ShadowComparison answerable;
    std::vector<ShadowVerdict> verdicts; // rows from top to bottom
    std::uint64_t missedPixels = 0;
    /// Lit-side pixels with N.L above 0.1, where bias is not capped, and those of them that are false shadows or leaks.
    std::uint64_t judgedPixels = 0;
    std::uint64_t unexplainedPixels = 0;

    double missedFraction() const;      // of the lit-side pixels
    double unexplainedFraction() const; // of the judged ones
};

/// Compares the shadows of the picture of `frame` that shows `surfaces` with `light`, which rays found against `scene`.
ShadowTruth shadowTruth(
    const raycast::Scene& scene,
    const executor::FrameDrawing& frame,
    const executor::Raster<executor::SurfaceSample>& surfaces,
    std::span<const raycast::Light> light);

} // namespace gnomon::proof
