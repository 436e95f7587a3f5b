#include "plan/scheme_choice.h"

#include "plan/hysteresis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::plan {

namespace {

std::uint64_t budgetOf(const Quality& quality) {
    return static_cast<std::uint64_t>(quality.shadowTexelsWidth) *
           static_cast<std::uint64_t>(quality.shadowTexelsHeight);
}

/// Rounds `texels` up to a power of 2^(1/4), so that the size of the texture does not change in every frame.
std::uint64_t quantizeTexels(std::uint64_t texels) {
    return static_cast<std::uint64_t>(std::ceil(std::exp2(std::ceil(std::log2(static_cast<double>(texels)) * 4) / 4)));
}

std::vector<double> splitsOf(const SchemeContext& context, int slices) {
    const shadow::ViewFrustum& frustum = context.view.frustum;
    return shadow::practicalSplits(frustum.near, frustum.far, slices, context.quality.splitLambda);
}

std::uint64_t emptySlicesOf(const SchemeContext& context, int slices) {
    if (!context.scene->light || context.quality.emptySlices == EmptySlices::Keep) return 0;
    const std::vector<double> splits = splitsOf(context, slices);
    if (!context.before || context.ignoreHistory) return slicesWithout(context.scene->light->lit, splits);
    const bool isSame = context.before->choice.slices == slices;
    return slicesWithoutMap(context.receivers, splits, *context.before, isSame);
}

shadow::ShadowOptions optionsOf(const SchemeContext& context, const SchemeChoice& choice) {
    const Quality& quality = context.quality;
    shadow::ShadowOptions options;
    options.scheme.warp = quality.warp;
    if (choice.logRows) options.scheme.warp.rule = shadow::WarpRule::Log;
    options.scheme.slices = choice.slices;
    options.scheme.splitLambda = quality.splitLambda;
    options.scheme.faces = choice.faces;
    options.chosenOrientation = choice.lightRoll;
    options.stabilized = quality.stabilize;
    options.filterTexels = quality.filter;
    options.texels = budgetOf(quality);
    options.emptySlices = emptySlicesOf(context, choice.slices);
    return options;
}

shadow::ShadowMapSetup setupOf(const SchemeContext& context, const shadow::ShadowOptions& options) {
    std::optional<shadow::OrientationState> orientation;
    if (context.before) orientation = context.before->orientation;
    return shadow::shadowMapSetup(context.view, options, orientation);
}

/// Computes the shadow maps of `candidate`, its numbers of caster triangles and its cost, all from candidate.options.
void completeCandidate(const SchemeContext& context, SchemeCandidate& candidate) {
    candidate.setup = setupOf(context, candidate.options);
    candidate.casterTriangles.clear();
    candidate.cost = static_cast<std::uint64_t>(candidate.setup.textureWidth) *
                     static_cast<std::uint64_t>(candidate.setup.textureHeight) / kTexelsPerTriangle;
    for (const shadow::ShadowMap& map : candidate.setup.maps) {
        const ConvexVolume volume =
            context.quality.cullCasters == CasterCulling::Off ? ConvexVolume{} : map.casterVolume;
        const std::uint64_t triangles =
            context.scene->light ? trianglesIn(volume, context.basis, context.scene->light->casters) : 0;
        candidate.casterTriangles.push_back(triangles);
        candidate.cost += shadow::hasLogRows(map.warped) ? triangles * kHalvesOfLogTriangle / 2 : triangles;
    }
}

std::uint64_t casterSum(const SchemeCandidate& candidate) {
    std::uint64_t sum = 0;
    for (const std::uint64_t triangles : candidate.casterTriangles)
        sum += triangles;
    return sum;
}

/// Returns true if face partitions lower the aliasing bound enough to be used. The comparison uses equal cost: the maps
/// with faces receive fewer texels, to compensate for their additional caster triangles. `gain` is set to the fraction
/// by which the faces lower the bound.
bool areFacesWorthIt(
    const SchemeContext& context, const SchemeCandidate& whole, const SchemeCandidate& faces, double& gain) {
    const std::uint64_t extra = casterSum(faces) - std::min(casterSum(faces), casterSum(whole));
    const std::uint64_t budget = budgetOf(context.quality);
    gain = 0;
    // with half the texels, the aliasing is 1.4 times as large
    if (extra * kTexelsPerTriangle * 2 > budget) return false;
    SchemeCandidate atSameCost;
    atSameCost.options = faces.options;
    atSameCost.options.texels = budget - extra * kTexelsPerTriangle;
    completeCandidate(context, atSameCost);
    gain = 1 - atSameCost.aliasingBound() / whole.aliasingBound();
    const bool isHeld = context.before && context.before->choice.faces;
    return atSameCost.aliasingBound() <= whole.aliasingBound() * (isHeld ? kStillWorthwhile : kWorthwhile);
}

SchemeCandidate chosenFaces(
    const SchemeContext& context, const std::vector<SchemeChoice>& choices, std::vector<SkippedEffect>& omitted) {
    SchemeCandidate whole = evaluate(context, choices[0]);
    if (choices.size() == 1) return whole;
    SchemeCandidate faces = evaluate(context, choices[1]);
    double gain = 0;
    if (!faces.setup.maps.empty() && areFacesWorthIt(context, whole, faces, gain)) return faces;
    omitted.push_back(
        {Effect::FacePartitions, gain > 0 ? SkipReason::GainTooSmall : SkipReason::NoGain, 0, std::max(0.0, gain)});
    return whole;
}

/// Returns the smaller of two required numbers of texels. The number 0 means that no number of texels suffices.
std::uint64_t lesserTexels(std::uint64_t a, std::uint64_t b) {
    return a == 0 || b == 0 ? std::max(a, b) : std::min(a, b);
}

/// Returns true if the shadow scheme `best` is clearly better than `before`, by the factor kCheaper in cost or kLower
/// in aliasing. Either both schemes or neither must stay within the max aliasing.
bool dominates(const SchemeCandidate& best, const SchemeCandidate& before) {
    if (best.isWithinMaxAliasing) return static_cast<double>(before.cost) * kCheaper > static_cast<double>(best.cost);
    return before.aliasingBound() * kLower > best.aliasingBound();
}

/// Returns the shadow scheme of the previous frame, evaluated for this frame, if the hysteresis keeps it in use
/// although `best` is better.
std::optional<SchemeCandidate> held(
    const SchemeContext& context, const std::vector<SchemeCandidate>& candidates, const SchemeCandidate& best) {
    // If a slice needs a map again, the image changes anyway, so the scheme can change in the same frame.
    if (!context.before || context.receivers.haveArrived) return std::nullopt;
    const SchemeChoice& before = context.before->choice;
    const auto same = std::find_if(candidates.begin(), candidates.end(), [&](const SchemeCandidate& a) {
        return a.choice.slices == before.slices && a.choice.faces == before.faces && a.choice.logRows == before.logRows;
    });
    if (same == candidates.end() || same->isWithinMaxAliasing != best.isWithinMaxAliasing) return std::nullopt;
    SchemeCandidate result = *same;
    result.framesDominated = dominates(best, *same) ? context.before->framesDominated + 1 : 0;
    if (result.framesDominated >= kFramesBeforeSchemeGoes) return std::nullopt;
    return result;
}

/// Returns the shadow scheme whose number of maps is closest to that of the previous frame, so that as few maps as
/// possible change. Schemes that `best` dominates are excluded.
SchemeCandidate nearestInMaps(
    const SchemeContext& context, const std::vector<SchemeCandidate>& candidates, const SchemeCandidate& best) {
    if (!context.before) return best;
    const auto maps = static_cast<std::ptrdiff_t>(context.before->maps);
    const auto change = [&](const SchemeCandidate& a) {
        return std::abs(static_cast<std::ptrdiff_t>(a.setup.maps.size()) - maps);
    };
    const SchemeCandidate* nearest = &best;
    for (const SchemeCandidate& a : candidates) {
        if (a.isWithinMaxAliasing != best.isWithinMaxAliasing || dominates(best, a)) continue;
        const bool isNearer = change(a) < change(*nearest);
        if (isNearer || (change(a) == change(*nearest) && isBetter(a, *nearest))) nearest = &a;
    }
    return *nearest;
}

std::vector<SchemeCandidate> candidatesOf(const SchemeContext& context, const std::vector<SchemeChoice>& choices) {
    std::vector<SchemeCandidate> candidates;
    candidates.reserve(choices.size());
    for (const SchemeChoice& choice : choices)
        candidates.push_back(evaluate(context, choice));
    return candidates;
}

/// Evaluates the shadow scheme of each choice. If all of them exceed the max aliasing, the function evaluates them
/// again without the receivers of earlier frames. Slices without a receiver in this frame then have no map, so the
/// other maps receive more texels. The function returns these second results if one of them stays within the max
/// aliasing.
std::vector<SchemeCandidate> bestCandidates(const SchemeContext& context, const std::vector<SchemeChoice>& choices) {
    const auto isWithinMaxAliasing = [](const SchemeCandidate& candidate) { return candidate.isWithinMaxAliasing; };
    std::vector<SchemeCandidate> candidates = candidatesOf(context, choices);
    if (!context.before || std::any_of(candidates.begin(), candidates.end(), isWithinMaxAliasing)) return candidates;
    SchemeContext now = context;
    now.ignoreHistory = true;
    std::vector<SchemeCandidate> bare;
    bare.reserve(candidates.size());
    for (const SchemeCandidate& with : candidates)
        bare.push_back(
            with.options.emptySlices == emptySlicesOf(now, with.choice.slices) ? with : evaluate(now, with.choice));
    return std::any_of(bare.begin(), bare.end(), isWithinMaxAliasing) ? bare : candidates;
}

/// Returns the best shadow scheme of `choices`, or the scheme of the previous frame if the hysteresis keeps it in use.
SchemeCandidate bestOf(const SchemeContext& context, const std::vector<SchemeChoice>& choices) {
    const std::vector<SchemeCandidate> candidates = bestCandidates(context, choices);
    const auto best = std::min_element(candidates.begin(), candidates.end(), isBetter);
    std::uint64_t minTexels = 0;
    for (const SchemeCandidate& candidate : candidates)
        minTexels = lesserTexels(minTexels, candidate.requiredTexels);
    std::optional<SchemeCandidate> stays = held(context, candidates, *best);
    SchemeCandidate chosen = stays ? std::move(*stays) : nearestInMaps(context, candidates, *best);
    if (!chosen.isWithinMaxAliasing) chosen.requiredTexels = minTexels;
    return chosen;
}

/// Returns the shadow scheme `chosen`. If the rotation of its maps about the light lowers the aliasing bound too
/// little, returns the same scheme without rotation.
SchemeCandidate inWorthwhileOrientation(
    const SchemeContext& context, SchemeCandidate chosen, std::vector<SkippedEffect>& omitted) {
    SchemeChoice plainChoice = chosen.choice;
    plainChoice.lightRoll = false;
    SchemeCandidate plain = evaluate(context, plainChoice);
    // Without the previous frame, the rotation of the maps is complete at once, so the comparison uses its full gain.
    // In the drawn frames, the speed limit distributes the rotation over several frames.
    SchemeContext afresh = context;
    afresh.before.reset();
    SchemeCandidate rolled = plain;
    rolled.options.chosenOrientation = true;
    completeCandidate(afresh, rolled);
    const bool isHeld = context.before && context.before->choice.lightRoll;
    const bool isWorthIt = rolled.aliasingBound() <= plain.aliasingBound() * (isHeld ? kStillWorthwhile : kWorthwhile);
    if (isWorthIt || plain.isWithinMaxAliasing != chosen.isWithinMaxAliasing) return chosen;
    omitted.push_back(
        {Effect::Orientation,
         SkipReason::GainTooSmall,
         0,
         std::max(0.0, 1 - rolled.aliasingBound() / plain.aliasingBound())});
    plain.framesDominated = chosen.framesDominated;
    plain.requiredTexels = lesserTexels(plain.requiredTexels, chosen.requiredTexels);
    return plain;
}

} // namespace

std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks) {
    ConvexVolume aroundEye; // planes in world axes relative to the eye, like the boxes of the caster blocks
    for (const Plane& plane : volume.planes)
        aroundEye.planes.push_back({toWorld(basis, plane.normal), plane.offset});
    std::uint64_t triangles = 0;
    for (const SceneFacts::CasterBlock& block : blocks)
        if (classify(aroundEye, block.box) != Containment::Outside) triangles += block.triangles;
    return triangles;
}

Receivers receiversOf(const SchemeContext& context) {
    if (!context.scene->light) return {};
    if (!context.before) return receiversNow(context.scene->light->lit, std::nullopt, {});
    const std::vector<double> splits = splitsOf(context, context.before->choice.slices);
    return receiversNow(context.scene->light->lit, context.before, splits);
}

SchemeCandidate evaluate(const SchemeContext& context, const SchemeChoice& choice) {
    SchemeCandidate result;
    result.choice = choice;
    result.options = optionsOf(context, choice);
    result.setup = setupOf(context, result.options);
    const double aliasing = context.quality.maxAliasing;
    result.requiredTexels = shadow::requiredTexels(result.setup, result.options, aliasing);
    const std::uint64_t budget = budgetOf(context.quality);
    const bool isSufficient = result.requiredTexels > 0 && result.requiredTexels <= budget;
    if (!context.quality.zPartitions && isSufficient)
        result.options.texels = std::min(budget, quantizeTexels(result.requiredTexels));
    completeCandidate(context, result);
    result.isWithinMaxAliasing = result.aliasingBound() <= aliasing;
    return result;
}

std::vector<SchemeChoice> openChoices(const SchemeContext& context) {
    const Quality& quality = context.quality;
    const int first = quality.zPartitions.value_or(1);
    const int last = quality.zPartitions.value_or(kMaxSlices);
    const Choice faces = quality.stabilize ? Choice::Off : quality.facePartitions;
    const bool areRowsOpen = !quality.zPartitions && quality.warp.rule == shadow::WarpRule::Auto &&
                             context.backend.unevenRows && !quality.stabilize;
    std::vector<SchemeChoice> choices;
    const auto add = [&](int slices, bool hasFaces) {
        choices.push_back({slices, hasFaces, true});
        if (areRowsOpen && slices == 1) choices.push_back({slices, hasFaces, true, true});
    };
    for (int slices = first; slices <= last; ++slices) {
        if (faces != Choice::On) add(slices, false);
        if (faces != Choice::Off) add(slices, true);
    }
    return choices;
}

bool isBetter(const SchemeCandidate& a, const SchemeCandidate& b) {
    if (a.isWithinMaxAliasing != b.isWithinMaxAliasing) return a.isWithinMaxAliasing;
    if (a.isWithinMaxAliasing) return a.cost < b.cost;
    const auto asked = [](const SchemeCandidate& candidate) {
        const SchemeChoice& choice = candidate.choice;
        return candidate.aliasingBound() / (choice.faces ? kWorthwhile : 1) / (choice.logRows ? kWorthwhile : 1);
    };
    return asked(a) < asked(b);
}

SchemeCandidate chosenScheme(const SchemeContext& context, std::vector<SkippedEffect>& omitted) {
    const Quality& quality = context.quality;
    const std::vector<SchemeChoice> choices = openChoices(context);
    SchemeCandidate chosen = quality.zPartitions ? chosenFaces(context, choices, omitted) : bestOf(context, choices);
    if (!quality.zPartitions && quality.facePartitions == Choice::Auto && !chosen.choice.faces && !quality.stabilize)
        omitted.push_back({Effect::FacePartitions, SkipReason::BetterWithout});
    if (quality.stabilize) {
        omitted.push_back({Effect::Orientation, SkipReason::SlicesStabilized});
    } else if (chosen.choice.faces && !chosen.setup.selector.faces.empty()) {
        omitted.push_back({Effect::Orientation, SkipReason::FacesGiveIt});
    } else {
        chosen = inWorthwhileOrientation(context, std::move(chosen), omitted);
    }
    return chosen;
}

} // namespace gnomon::plan
