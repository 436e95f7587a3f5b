// Chooses a shadow scheme (slices, face partitions and warp) among the schemes that the user's settings permit. The
// choice compares estimated costs and aliasing bounds, with hysteresis in favour of the scheme of the previous frame.
#pragma once

#include "plan/empty_slices.h"
#include "plan/frame_plan.h"
#include "shadow/setup.h"

#include <span>

namespace gnomon::plan {

/// The input for the choice of a shadow scheme.
struct SchemeContext {
    shadow::ShadowView view;
    CameraBasis basis;
    Quality quality;
    const SceneFacts* scene = nullptr;
    Capabilities backend;
    std::optional<SchemeMemory> before; // scheme and hysteresis state of the previous frame, if it had a scheme
    Receivers receivers;                // receivers of this frame and of recent frames
    // true: a slice without a receiver in this frame is empty, even if earlier frames had receivers there
    bool ignoreHistory = false;
};

/// A possible shadow scheme of a frame with its maps, its cost and its aliasing bound.
struct SchemeCandidate {
    SchemeChoice choice;
    shadow::ShadowOptions options;
    shadow::ShadowMapSetup setup;
    std::vector<std::uint64_t> casterTriangles; // estimated number of caster triangles per map
    std::uint64_t cost = 0;           // in caster triangles: texels / kTexelsPerTriangle + weighted caster triangles
    std::uint64_t requiredTexels = 0; // number of texels required for quality.maxAliasing; 0: no number suffices
    bool isWithinMaxAliasing = false;
    int framesDominated = 0; // number of consecutive frames up to this frame in which another scheme was clearly better

    double aliasingBound() const { return setup.worst().worst(); }
};

/// Number of shadow map texels whose clearing and storage cost as much as one caster triangle.
constexpr std::uint64_t kTexelsPerTriangle = 16;

/// Cost of drawing a caster triangle into a logarithmic map, in halves of its cost in a map with evenly spaced rows.
/// With small triangles, logarithmic maps are drawn at 0.73 of the triangle rate of evenly spaced rows. With large
/// triangles, the rate is lower.
constexpr std::uint64_t kHalvesOfLogTriangle = 3;

/// Max number of depth slices that the setting `auto` can choose.
constexpr int kMaxSlices = 12;

/// Sets up the maps of the shadow scheme `choice` and computes their cost. If the user gave no number of slices, the
/// maps have only the texels that the max aliasing requires, rounded up to a step of 2^(1/4). If the user gave a
/// number, or if the budget is too small for the max aliasing, the maps have the whole budget of texels.
SchemeCandidate evaluate(const SchemeContext& context, const SchemeChoice& choice);

/// Returns the shadow schemes that the settings permit, fewest slices first. Logarithmic maps are included if the
/// number of slices and the warp are both `auto` and the backend draws such maps. They use one slice: logarithms of
/// depth ratios add up, so more slices do not reduce the required texels.
std::vector<SchemeChoice> openChoices(const SchemeContext& context);

/// Returns true if shadow scheme `a` is better than `b`. A scheme that stays within the max aliasing is better than a
/// scheme that exceeds it. If both stay within it, the lower cost is better. If both exceed it, the lower aliasing
/// bound is better, but face partitions and logarithmic rows must each lower the bound by the factor kWorthwhile.
bool isBetter(const SchemeCandidate& a, const SchemeCandidate& b);

/// Returns the receivers of the frame in `context`, combined with the receivers of recent frames.
Receivers receiversOf(const SchemeContext& context);

/// Returns the best shadow scheme for the view. For each effect that the scheme skips, adds the reason to `omitted`.
SchemeCandidate chosenScheme(const SchemeContext& context, std::vector<SkippedEffect>& omitted);

/// Estimates the number of caster triangles in `volume` (camera space) as the number of triangles in all blocks that
/// intersect it.
std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks);

} // namespace gnomon::plan
