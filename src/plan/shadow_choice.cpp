#include "plan/shadow_choice.h"

#include "plan/hysteresis.h"

namespace gnomon::plan {

namespace {

// Nanoseconds, about: weights with which choosing takes little time over 272 views of six models, predicted counts
// beside measured frames of both kinds (bench/fit_shadow_choice; docs/exact_shadows.md says how near that comes to the
// better of the two).
constexpr double kSample = 128; // listed, sorted, and shaded in both colours
constexpr double kCasterTriangle = 1;
constexpr double kCastTriangle = 419;
constexpr double kSampleTest = 0.5;
constexpr double kMapsAtAll = 2.1e6; // four maps in 2048x2048 texels
constexpr double kMapLookup = 2;
constexpr double kMapCaster = 18;
constexpr double kMapTriangle = 69;
constexpr double kMapFragment = 2.2;

} // namespace

ShadowCosts shadowCosts(const ExactWork& work) {
    return {
        kSample * work.samples + kCasterTriangle * work.casterTriangles + kCastTriangle * work.castTriangles +
            kSampleTest * work.sampleTests,
        kMapsAtAll + kMapLookup * work.samples + kMapCaster * work.casterTriangles + kMapTriangle * work.keptTriangles +
            kMapFragment * work.mapFragments};
}

std::optional<ModeMemory> withoutCosts(const std::optional<ModeMemory>& before) {
    if (!before || before->framesDominated > 0 || before->framesUnasked + 1 >= kFramesBetweenCosts) return std::nullopt;
    ModeMemory memory = *before;
    ++memory.framesUnasked;
    return memory;
}

ShadowChoice choiceByCosts(const ShadowCosts& costs, const std::optional<ModeMemory>& before) {
    const bool isExactBest = costs.exact <= costs.maps;
    bool isExact = isExactBest;
    int framesDominated = 0;
    if (before && before->isExact != isExactBest) {
        const bool isDominated =
            isExactBest ? costs.exact < kCheaper * costs.maps : costs.maps < kCheaper * costs.exact;
        framesDominated = isDominated ? before->framesDominated + 1 : 0;
        isExact = framesDominated >= kFramesBeforeModeGoes ? isExactBest : before->isExact;
    }
    ShadowChoice choice;
    choice.mode = isExact ? ShadowMode::Exact : ShadowMode::Maps;
    choice.reason = isExact ? ShadowReason::ExactCostsNoMore : ShadowReason::MapsCostLess;
    if (isExact != isExactBest) choice.reason = ShadowReason::Held;
    choice.memory = ModeMemory{isExact, isExact == isExactBest ? 0 : framesDominated, 0, false};
    return choice;
}

} // namespace gnomon::plan
