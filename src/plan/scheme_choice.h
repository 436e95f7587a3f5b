// Which of the schemes that the user leaves open a view calls for: counted costs, kept promises, and hysteresis towards
// the scheme of the frame before.
#pragma once

#include "plan/empty_slices.h"
#include "plan/frame_plan.h"
#include "shadow/setup.h"

#include <span>

namespace gnomon::plan {

/// All that decides between schemes.
struct SchemeContext {
    shadow::ShadowView view;
    CameraBasis basis;
    Quality quality;
    const SceneFacts* scene = nullptr;
    Capabilities backend;
    std::optional<SchemeMemory> before; // of the frame before, if it had a scheme
    Receivers receivers;                // after it
    bool ignoreHistory = false;         // slices are empty where nothing in this very frame needs them
};

/// A scheme worked out.
struct SchemeCandidate {
    SchemeChoice choice;
    shadow::ShadowOptions options;
    shadow::ShadowMapSetup setup;
    std::vector<std::uint64_t> casterTriangles; // by map, estimated
    std::uint64_t cost = 0;                     // see kTexelsPerTriangle
    std::uint64_t texelsThatWouldDo = 0;        // to keep quality.maxAliasing; 0: none
    bool keepsPromise = false;
    int framesDominated = 0; // see SchemeMemory

    double promise() const { return setup.worst().worst(); }
};

/// Texels that are cleared and kept for the cost of a caster triangle.
constexpr std::uint64_t kTexelsPerTriangle = 16;

/// What a caster triangle counts for in a map whose rows are logarithmic, in halves of one in a map of even rows: such
/// maps are drawn at 0.73 of the rate of others where triangles are small, and slower where they are large.
constexpr std::uint64_t kHalvesOfLogTriangle = 3;

/// The most slices that `auto` considers.
constexpr int kMostSlices = 12;

/// `choice` worked out. Where the number of slices is left open it takes no more texels than the promise asks for, in
/// quantised steps of 2^(1/4); else all of the budget.
SchemeCandidate evaluate(const SchemeContext& context, const SchemeChoice& choice);

/// The schemes that the quality leaves open, fewest maps first; logarithmic rows where slices and warp both are and the
/// backend draws them: in one slice, as logarithms add, and more slices lower nothing.
std::vector<SchemeChoice> openChoices(const SchemeContext& context);

/// Whether `a` is to be preferred to `b`: a kept promise, then, where both keep it, the lower cost, else the lower
/// promise.
bool isBetter(const SchemeCandidate& a, const SchemeCandidate& b);

/// The receivers of the frame that is asked about.
Receivers receiversOf(const SchemeContext& context);

/// The scheme for the view, with a line in `omitted` for each effect that it goes without.
SchemeCandidate chosenScheme(const SchemeContext& context, std::vector<Omission>& omitted);

/// The triangles of the blocks that touch `volume` (camera space).
std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks);

} // namespace gnomon::plan
