// The choice of a scheme from the schemes that the user's settings permit. The choice compares estimated costs and
// aliasing bounds, with hysteresis in favour of the previous scheme.
#pragma once

#include "plan/empty_slices.h"
#include "plan/frame_plan.h"
#include "shadow/setup.h"

#include <span>

namespace gnomon::plan {

/// The input of the choice.
struct SchemeContext {
    shadow::ShadowView view;
    CameraBasis basis;
    Quality quality;
    const SceneFacts* scene = nullptr;
    Capabilities backend;
    std::optional<SchemeMemory> before; // the previous frame, if it had a scheme
    Receivers receivers;                // the receivers after `before`, including this frame
    // true: a slice without a receiver in this frame is empty, even if earlier frames had receivers there
    bool ignoreHistory = false;
};

/// A scheme with its maps, its cost and its aliasing bound.
struct SchemeCandidate {
    SchemeChoice choice;
    shadow::ShadowOptions options;
    shadow::ShadowMapSetup setup;
    std::vector<std::uint64_t> casterTriangles; // estimated number per map
    std::uint64_t cost = 0;           // in caster triangles: texels / kTexelsPerTriangle + weighted caster triangles
    std::uint64_t requiredTexels = 0; // number required for quality.maxAliasing; 0: no number suffices
    bool isWithinMaxAliasing = false;
    int framesDominated = 0; // as in SchemeMemory

    double aliasingBound() const { return setup.worst().worst(); }
};

/// Number of texels whose clearing and storage cost as much as one caster triangle.
constexpr std::uint64_t kTexelsPerTriangle = 16;

/// Cost of a caster triangle in a logarithmic map, in halves of its cost in a map with even rows. Logarithmic maps are
/// drawn at 0.73 of the rate of even rows if triangles are small, and more slowly if they are large.
constexpr std::uint64_t kHalvesOfLogTriangle = 3;

/// Max number of slices that `auto` considers.
constexpr int kMaxSlices = 12;

/// Returns the candidate for `choice`. If the number of slices is open, the candidate uses only the texels that the max
/// aliasing requires, rounded up to a step of 2^(1/4). Otherwise, or if the budget is too small for the max aliasing,
/// it uses the whole budget.
SchemeCandidate evaluate(const SchemeContext& context, const SchemeChoice& choice);

/// Returns the schemes that the quality permits, fewest slices first. Logarithmic maps are included if both the number
/// of slices and the warp are open and the backend draws them. They use one slice: logarithms of depth ratios add up,
/// so more slices do not reduce the storage.
std::vector<SchemeChoice> openChoices(const SchemeContext& context);

/// Returns true if `a` is better than `b`. A candidate that stays within the max aliasing is better than a candidate
/// that exceeds it. If both stay within it, the lower cost is better. If both exceed it, the lower aliasing bound is
/// better. Face partitions and logarithmic rows must then lower the bound by a factor of kWorthwhile each.
bool isBetter(const SchemeCandidate& a, const SchemeCandidate& b);

/// Returns the receivers of the context's frame, together with the memory of earlier frames.
Receivers receiversOf(const SchemeContext& context);

/// Returns the scheme for the view. Adds an entry to `omitted` for each effect that it skips.
SchemeCandidate chosenScheme(const SchemeContext& context, std::vector<SkippedEffect>& omitted);

/// Returns the number of triangles in the blocks that intersect `volume` (camera space).
std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks);

} // namespace gnomon::plan
