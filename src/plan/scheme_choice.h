// The choice of a scheme among the schemes that the user's settings permit. The choice compares estimated costs and
// aliasing bounds, with hysteresis in favour of the scheme of the previous frame.
#pragma once

#include "plan/empty_slices.h"
#include "plan/frame_plan.h"
#include "shadow/setup.h"

#include <span>

namespace gnomon::plan {

/// The input for the choice of a scheme.
struct SchemeContext {
    shadow::ShadowView view;
    CameraBasis basis;
    Quality quality;
    const SceneFacts* scene = nullptr;
    Capabilities backend;
    std::optional<SchemeMemory> before; // scheme of the previous frame, if it had one
    Receivers receivers;                // receivers of the frames after `before`, including this frame
    // true: a slice without a receiver in this frame is empty, even if earlier frames had receivers there
    bool ignoreHistory = false;
};

/// A scheme with its maps, its cost and its aliasing bound.
struct SchemeCandidate {
    SchemeChoice choice;
    shadow::ShadowOptions options;
    shadow::ShadowMapSetup setup;
    std::vector<std::uint64_t> casterTriangles; // estimated number of caster triangles per map
    std::uint64_t cost = 0;           // in caster triangles: texels / kTexelsPerTriangle + weighted caster triangles
    std::uint64_t requiredTexels = 0; // number of texels required for quality.maxAliasing; 0: no number suffices
    bool isWithinMaxAliasing = false;
    int framesDominated = 0; // as in SchemeMemory

    double aliasingBound() const { return setup.worst().worst(); }
};

/// Number of texels whose clearing and storage cost as much as one caster triangle.
constexpr std::uint64_t kTexelsPerTriangle = 16;

/// Cost of a caster triangle in a logarithmic map, in halves of its cost in a map with evenly spaced rows. With small
/// triangles, logarithmic maps are drawn at 0.73 of the triangle rate of evenly spaced rows. With large triangles, the
/// rate is lower.
constexpr std::uint64_t kHalvesOfLogTriangle = 3;

/// Max number of slices that the setting `auto` can choose.
constexpr int kMaxSlices = 12;

/// Returns the candidate for `choice`, with its maps and cost. If the user gave no number of slices, the candidate has
/// only the texels that the max aliasing requires, rounded up to a step of 2^(1/4). If the user gave a number, or if
/// the budget is too small for the max aliasing, the candidate has the whole budget of texels.
SchemeCandidate evaluate(const SchemeContext& context, const SchemeChoice& choice);

/// Returns the schemes that the quality permits, fewest slices first. Logarithmic maps are included if the number of
/// slices and the warp are both `auto` and the backend draws such maps. They use one slice: logarithms of depth ratios
/// add up, so more slices do not reduce the required texels.
std::vector<SchemeChoice> openChoices(const SchemeContext& context);

/// Returns true if candidate `a` is better than `b`. A candidate that stays within the max aliasing is better than a
/// candidate that exceeds it. If both stay within it, the lower cost is better. If both exceed it, the lower aliasing
/// bound is better, but face partitions and logarithmic rows must each lower the bound by the factor kWorthwhile.
bool isBetter(const SchemeCandidate& a, const SchemeCandidate& b);

/// Returns the receivers of the context's frame, together with the memory of earlier frames.
Receivers receiversOf(const SchemeContext& context);

/// Returns the scheme for the view. For each effect that the scheme skips, adds the reason to `omitted`.
SchemeCandidate chosenScheme(const SchemeContext& context, std::vector<SkippedEffect>& omitted);

/// Returns the number of triangles in the caster blocks that intersect `volume`, which is in camera space.
std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks);

} // namespace gnomon::plan
