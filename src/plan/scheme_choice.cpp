#include "plan/scheme_choice.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace gnomon::plan {

namespace {

std::uint64_t budgetOf(const Quality& quality) {
    return static_cast<std::uint64_t>(quality.shadowTexelsWidth) *
           static_cast<std::uint64_t>(quality.shadowTexelsHeight);
}

/// The next step of a ladder of 2^(1/4) from `texels` up, so that the texture does not change its size all the time.
std::uint64_t texelRung(std::uint64_t texels) {
    return static_cast<std::uint64_t>(std::ceil(std::exp2(std::ceil(std::log2(static_cast<double>(texels)) * 4) / 4)));
}

std::vector<double> splitsOf(const SchemeQuestion& question, int slices) {
    const shadow::ViewFrustum& frustum = question.view.frustum;
    return shadow::practicalSplits(frustum.near, frustum.far, slices, question.quality.splitLambda);
}

std::uint64_t emptySlicesOf(const SchemeQuestion& question, int slices) {
    if (!question.scene->light) return 0;
    const std::vector<double> splits = splitsOf(question, slices);
    if (question.previous == nullptr || question.forgets) return slicesWithout(question.scene->light->lit, splits);
    const bool isSame = question.previous->scheme->slices == slices;
    return slicesWithoutMap(question.receivers, splits, *question.previous, isSame);
}

shadow::ShadowOptions optionsOf(const SchemeQuestion& question, const SchemeChoice& choice) {
    const Quality& quality = question.quality;
    shadow::ShadowOptions options;
    options.scheme.warp = quality.warp;
    options.scheme.slices = choice.slices;
    options.scheme.splitLambda = quality.splitLambda;
    options.scheme.faces = choice.faces;
    options.chosenOrientation = choice.turned;
    options.stabilized = quality.stabilize;
    options.filterTexels = quality.filter;
    options.texels = budgetOf(quality);
    options.emptySlices = emptySlicesOf(question, choice.slices);
    return options;
}

shadow::ShadowMapSetup setupOf(const SchemeQuestion& question, const shadow::ShadowOptions& options) {
    const auto orientation = question.previous != nullptr ? question.previous->orientation : std::nullopt;
    return shadow::shadowMapSetup(question.view, options, orientation);
}

/// Completes `answer` from its options.
void workOut(const SchemeQuestion& question, SchemeAnswer& answer) {
    answer.setup = setupOf(question, answer.options);
    answer.casterTriangles.clear();
    answer.cost = static_cast<std::uint64_t>(answer.setup.textureWidth) *
                  static_cast<std::uint64_t>(answer.setup.textureHeight) / kTexelsPerTriangle;
    for (const shadow::ShadowMapPartition& map : answer.setup.maps) {
        const ConvexVolume volume = question.quality.cullCasters ? map.casterVolume : ConvexVolume{};
        const std::uint64_t triangles =
            question.scene->light ? trianglesIn(volume, question.basis, question.scene->light->casters) : 0;
        answer.casterTriangles.push_back(triangles);
        answer.cost += triangles;
    }
}

std::uint64_t casterSum(const SchemeAnswer& answer) {
    std::uint64_t sum = 0;
    for (const std::uint64_t triangles : answer.casterTriangles)
        sum += triangles;
    return sum;
}

std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f%%", share * 100);
    return text.data();
}

/// Whether faces are worth it where the slices are given: by what they promise with the texels that are left when
/// their further caster triangles are paid for. `gain` is by what share they lower the promise.
bool areFacesWorthIt(
    const SchemeQuestion& question, const SchemeAnswer& whole, const SchemeAnswer& faces, double& gain) {
    const std::uint64_t extra = casterSum(faces) - std::min(casterSum(faces), casterSum(whole));
    const std::uint64_t budget = budgetOf(question.quality);
    gain = 0;
    if (extra * kTexelsPerTriangle * 2 > budget) return false; // half the texels less: 1.4 times the error
    SchemeAnswer paid;
    paid.options = faces.options;
    paid.options.texels = budget - extra * kTexelsPerTriangle;
    workOut(question, paid);
    gain = 1 - paid.promise() / whole.promise();
    const bool isHeld = question.previous != nullptr && question.previous->scheme->faces;
    return paid.promise() <= whole.promise() * (isHeld ? kStillWorthwhile : kWorthwhile);
}

SchemeAnswer chosenFaces(
    const SchemeQuestion& question, const std::vector<SchemeChoice>& choices, std::vector<Omission>& omitted) {
    SchemeAnswer whole = answer(question, choices[0]);
    if (choices.size() == 1) return whole;
    SchemeAnswer faces = answer(question, choices[1]);
    double gain = 0;
    if (!faces.setup.maps.empty() && areFacesWorthIt(question, whole, faces, gain)) return faces;
    omitted.push_back(
        {"face partitions",
         gain > 0 ? "at the same cost they would lower the promise by " + percent(gain) + ", less than 5%"
                  : "at the same cost they would not lower the promise"});
    return whole;
}

/// The lesser of two numbers of texels that would do; 0 is none.
std::uint64_t lesserTexels(std::uint64_t a, std::uint64_t b) {
    return a == 0 || b == 0 ? std::max(a, b) : std::min(a, b);
}

/// Whether `best` is better by far than the scheme of the frame before; neither or both keep the promise.
bool outdoes(const SchemeAnswer& best, const SchemeAnswer& before) {
    if (best.keepsPromise) return static_cast<double>(before.cost) * kCheaper > static_cast<double>(best.cost);
    return before.promise() * kLower > best.promise();
}

/// The scheme of the frame before, worked out for this one, if it stays although `best` is better.
std::optional<SchemeAnswer> held(
    const SchemeQuestion& question, const std::vector<SchemeAnswer>& answers, const SchemeAnswer& best) {
    // Where maps have to come, they may come with another scheme as well.
    if (question.previous == nullptr || question.receivers.haveArrived) return std::nullopt;
    const SchemeChoice& before = *question.previous->scheme;
    const auto same = std::find_if(answers.begin(), answers.end(), [&](const SchemeAnswer& a) {
        return a.choice.slices == before.slices && a.choice.faces == before.faces;
    });
    if (same == answers.end() || same->keepsPromise != best.keepsPromise) return std::nullopt;
    SchemeAnswer result = *same;
    result.framesOutdone = outdoes(best, *same) ? question.previous->framesOutdone + 1 : 0;
    if (result.framesOutdone >= kFramesBeforeSchemeGoes) return std::nullopt;
    return result;
}

/// Of those that `best` does not outdo the one with as many maps as the frame before, or nearest to that: what has to
/// change changes the number of maps the least.
SchemeAnswer nearestInMaps(
    const SchemeQuestion& question, const std::vector<SchemeAnswer>& answers, const SchemeAnswer& best) {
    if (question.previous == nullptr) return best;
    const auto maps = static_cast<std::ptrdiff_t>(question.previous->passes.size());
    const auto change = [&](const SchemeAnswer& a) {
        return std::abs(static_cast<std::ptrdiff_t>(a.setup.maps.size()) - maps);
    };
    const SchemeAnswer* nearest = &best;
    for (const SchemeAnswer& a : answers) {
        if (a.keepsPromise != best.keepsPromise || outdoes(best, a)) continue;
        const bool isNearer = change(a) < change(*nearest);
        if (isNearer || (change(a) == change(*nearest) && isBetter(a, *nearest))) nearest = &a;
    }
    return *nearest;
}

std::vector<SchemeAnswer> answersOf(const SchemeQuestion& question, const std::vector<SchemeChoice>& choices) {
    std::vector<SchemeAnswer> answers;
    answers.reserve(choices.size());
    for (const SchemeChoice& choice : choices)
        answers.push_back(answer(question, choice));
    return answers;
}

/// All choices worked out. Where none keeps the promise, with no map that this very frame does not need if one does
/// then.
std::vector<SchemeAnswer> bestAnswers(const SchemeQuestion& question, const std::vector<SchemeChoice>& choices) {
    const auto keepsPromise = [](const SchemeAnswer& answer) { return answer.keepsPromise; };
    std::vector<SchemeAnswer> answers = answersOf(question, choices);
    if (question.previous == nullptr || std::any_of(answers.begin(), answers.end(), keepsPromise)) return answers;
    SchemeQuestion now = question;
    now.forgets = true;
    std::vector<SchemeAnswer> bare;
    bare.reserve(answers.size());
    for (const SchemeAnswer& with : answers)
        bare.push_back(
            with.options.emptySlices == emptySlicesOf(now, with.choice.slices) ? with : answer(now, with.choice));
    return std::any_of(bare.begin(), bare.end(), keepsPromise) ? bare : answers;
}

/// The best of all slices and faces; what the frame before had unless another is better by far.
SchemeAnswer bestOf(const SchemeQuestion& question, const std::vector<SchemeChoice>& choices) {
    const std::vector<SchemeAnswer> answers = bestAnswers(question, choices);
    const auto best = std::min_element(answers.begin(), answers.end(), isBetter);
    std::uint64_t leastTexels = 0;
    for (const SchemeAnswer& tried : answers)
        leastTexels = lesserTexels(leastTexels, tried.texelsThatWouldDo);
    std::optional<SchemeAnswer> stays = held(question, answers, *best);
    SchemeAnswer chosen = stays ? std::move(*stays) : nearestInMaps(question, answers, *best);
    if (!chosen.keepsPromise) chosen.texelsThatWouldDo = leastTexels;
    return chosen;
}

/// `chosen`, or the same in the plain orientation where turning it about the light is not worth it.
SchemeAnswer inWorthwhileOrientation(
    const SchemeQuestion& question, SchemeAnswer chosen, std::vector<Omission>& omitted) {
    SchemeChoice plainChoice = chosen.choice;
    plainChoice.turned = false;
    SchemeAnswer plain = answer(question, plainChoice);
    // What the turn is worth once it is reached: from frame to frame it is only approached.
    SchemeQuestion afresh = question;
    afresh.previous = nullptr;
    SchemeAnswer turned = plain;
    turned.options.chosenOrientation = true;
    workOut(afresh, turned);
    const bool isHeld = question.previous != nullptr && question.previous->scheme->turned;
    const bool isWorthIt = turned.promise() <= plain.promise() * (isHeld ? kStillWorthwhile : kWorthwhile);
    if (isWorthIt || plain.keepsPromise != chosen.keepsPromise) return chosen;
    omitted.push_back(
        {"orientation",
         "a turn about the light would lower the promise by " +
             percent(std::max(0.0, 1 - turned.promise() / plain.promise())) + ", less than 5%"});
    plain.framesOutdone = chosen.framesOutdone;
    plain.texelsThatWouldDo = lesserTexels(plain.texelsThatWouldDo, chosen.texelsThatWouldDo);
    return plain;
}

} // namespace

std::uint64_t trianglesIn(
    const ConvexVolume& volume, const CameraBasis& basis, std::span<const SceneFacts::CasterBlock> blocks) {
    ConvexVolume aroundEye; // in world axes, as the blocks are
    for (const Plane& plane : volume.planes)
        aroundEye.planes.push_back({toWorld(basis, plane.normal), plane.offset});
    std::uint64_t triangles = 0;
    for (const SceneFacts::CasterBlock& block : blocks)
        if (classify(aroundEye, block.box) != Containment::Outside) triangles += block.triangles;
    return triangles;
}

Receivers receiversOf(const SchemeQuestion& question) {
    if (!question.scene->light) return {};
    if (question.previous == nullptr) return receiversNow(question.scene->light->lit, nullptr, {});
    const std::vector<double> splits = splitsOf(question, question.previous->scheme->slices);
    return receiversNow(question.scene->light->lit, question.previous, splits);
}

SchemeAnswer answer(const SchemeQuestion& question, const SchemeChoice& choice) {
    SchemeAnswer result;
    result.choice = choice;
    result.options = optionsOf(question, choice);
    result.setup = setupOf(question, result.options);
    const double aliasing = question.quality.maxAliasing;
    result.texelsThatWouldDo = shadow::texelsThatWouldDo(result.setup, result.options, aliasing);
    const std::uint64_t budget = budgetOf(question.quality);
    const bool isEnough = result.texelsThatWouldDo > 0 && result.texelsThatWouldDo <= budget;
    if (!question.quality.zPartitions && isEnough)
        result.options.texels = std::min(budget, texelRung(result.texelsThatWouldDo));
    workOut(question, result);
    result.keepsPromise = result.promise() <= aliasing;
    return result;
}

std::vector<SchemeChoice> openChoices(const SchemeQuestion& question) {
    const Quality& quality = question.quality;
    const int first = quality.zPartitions.value_or(1);
    const int last = quality.zPartitions.value_or(kMostSlices);
    const Choice faces = quality.stabilize ? Choice::Off : quality.facePartitions;
    std::vector<SchemeChoice> choices;
    for (int slices = first; slices <= last; ++slices) {
        if (faces != Choice::On) choices.push_back({slices, false, true});
        if (faces != Choice::Off) choices.push_back({slices, true, true});
    }
    return choices;
}

bool isBetter(const SchemeAnswer& a, const SchemeAnswer& b) {
    if (a.keepsPromise != b.keepsPromise) return a.keepsPromise;
    if (a.keepsPromise) return a.cost < b.cost;
    const auto asked = [](const SchemeAnswer& answer) {
        return answer.promise() / (answer.choice.faces ? kWorthwhile : 1);
    };
    return asked(a) < asked(b);
}

SchemeAnswer chosenScheme(const SchemeQuestion& question, std::vector<Omission>& omitted) {
    const Quality& quality = question.quality;
    const std::vector<SchemeChoice> choices = openChoices(question);
    SchemeAnswer chosen = quality.zPartitions ? chosenFaces(question, choices, omitted) : bestOf(question, choices);
    if (!quality.zPartitions && quality.facePartitions == Choice::Auto && !chosen.choice.faces && !quality.stabilize)
        omitted.push_back({"face partitions", "without them the promise costs less, or is lower by 5% at least"});
    if (quality.stabilize) {
        omitted.push_back({"orientation", "stabilised slices keep that of the world"});
    } else if (chosen.choice.faces && !chosen.setup.selector.faces.empty()) {
        omitted.push_back({"orientation", "the maps of faces follow their edges"});
    } else {
        chosen = inWorthwhileOrientation(question, std::move(chosen), omitted);
    }
    return chosen;
}

} // namespace gnomon::plan
