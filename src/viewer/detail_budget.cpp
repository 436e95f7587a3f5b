#include "viewer/detail_budget.h"

#include "core/formatted.h"
#include "plan/plan_frame.h"

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

constexpr std::array kAllLevers = {Lever::Detail, Lever::Slices, Lever::Texels, Lever::Resolution, Lever::Exactness};
constexpr int kDetailSteps = 8;     // half octaves: up to 16 times the error
constexpr int kTexelSteps = 4;      // down to a sixteenth of the texels
constexpr int kResolutionSteps = 4; // quarter octaves of a side: down to half the resolution
constexpr double kOver = 1.03;      // in targets; a longer frame exceeds the target
constexpr double kComfort = 0.85;   // in targets; a frame after a step back must stay below this
constexpr int kFramesToTakeBack = 12;
constexpr double kTrianglesPerPixel = 1; // shading cost of a pixel, in drawn triangles
constexpr double kLeastShare = 0.005;    // min saving of a step, as a share of the frame time
constexpr double kLearning = 0.3;
constexpr double kMaxExactOverMaps = 16;

double root(int steps, double perOctave) {
    return std::exp2(steps / perOctave);
}

std::optional<double> largest(const plan::FramePlan& plan) {
    if (plan.passes.empty()) return std::nullopt;
    return std::max(plan.promised.x, plan.promised.z);
}

} // namespace

ShadowErrors shadowErrors(const plan::FramePlan& plan, const plan::SceneFacts& facts, bool withLess) {
    ShadowErrors errors;
    errors.promised = largest(plan);
    if (withLess && plan.quality.shadows == plan::ShadowMode::Exact &&
        plan.shadowReason != plan::ShadowReason::Requested && !plan.view.pointLight) {
        plan::Quality maps = plan.quality;
        maps.shadows = plan::ShadowMode::Maps;
        errors.asMaps = largest(plan::planFrame(plan.view, maps, facts, {}, plan.backend).plan);
    }
    if (!errors.promised) return errors;
    const double texels = static_cast<double>(plan.textureWidth) * plan.textureHeight / 16;
    errors.texelShare = texels / std::max(static_cast<double>(plan.cost), texels);
    if (!withLess) return errors;
    const auto promisedWith = [&](const plan::Quality& quality) {
        return largest(plan::planFrame(plan.view, quality, facts, {}, plan.backend).plan);
    };
    plan::Quality fewer = plan.quality;
    if (fewer.zPartitions.value_or(1) > 1) {
        --*fewer.zPartitions;
        errors.fewerSlices = promisedWith(fewer);
    }
    fewer = plan.quality;
    fewer.shadowTexelsHeight = std::max(fewer.shadowTexelsHeight / 2, 1);
    errors.fewerTexels = promisedWith(fewer);
    return errors;
}

int DetailBudget::most(Lever lever, const Effort& wanted) {
    switch (lever) {
    case Lever::Detail:
        return kDetailSteps;
    case Lever::Slices:
        return wanted.slices.value_or(1) - 1;
    case Lever::Texels:
        return kTexelSteps;
    case Lever::Resolution:
        return kResolutionSteps;
    case Lever::Exactness:
        return wanted.mayBeExact ? 1 : 0;
    }
    return 0;
}

Effort DetailBudget::effortOf(const Steps& steps, const Effort& wanted) {
    const auto of = [&](Lever lever) { return std::min(steps[static_cast<std::size_t>(lever)], most(lever, wanted)); };
    Effort effort = wanted;
    effort.errorPixels = wanted.errorPixels * root(of(Lever::Detail), 2);
    if (wanted.slices) effort.slices = *wanted.slices - of(Lever::Slices);
    const double side = root(-of(Lever::Texels), 2);
    effort.texelsWidth = std::max(static_cast<int>(std::lround(wanted.texelsWidth * side)), 1);
    effort.texelsHeight = std::max(static_cast<int>(std::lround(wanted.texelsHeight * side)), 1);
    effort.resolution = wanted.resolution * root(-of(Lever::Resolution), 4);
    effort.mayBeExact = wanted.mayBeExact && of(Lever::Exactness) == 0;
    return effort;
}

Effort DetailBudget::effort(const Effort& wanted) const {
    return effortOf(steps_, wanted);
}

/// Returns the time that depends on the triangles of the image and of the cuts for it.
double DetailBudget::detailMs(const FrameLoad& load) const {
    const double work = load.triangles + kTrianglesPerPixel * load.pixels;
    const double ofImage = work > 0 ? load.imageMs * load.triangles / work : 0;
    return ofImage + load.shadowMs * (load.decidesPoints ? 0.5 : 1 - load.errors.texelShare);
}

/// Returns the time that depends on the pixels of the image.
double DetailBudget::pixelMs(const FrameLoad& load) const {
    const double work = load.triangles + kTrianglesPerPixel * load.pixels;
    const double ofImage = work > 0 ? load.imageMs * kTrianglesPerPixel * load.pixels / work : 0;
    return ofImage + (load.decidesPoints ? 0.5 * load.shadowMs : 0);
}

DetailBudget::Change DetailBudget::giveUp(Lever lever, const FrameLoad& load, const Effort& now) const {
    const double pixel = 1 / now.resolution; // size of a drawn pixel in pixels of the window
    const double promised = load.errors.promised.value_or(0);
    switch (lever) {
    case Lever::Detail:
        return {lever, now.errorPixels * (root(1, 2) - 1), detailMs(load) * (1 - std::exp2(-elasticity_ / 2))};
    case Lever::Slices:
        if (!load.errors.fewerSlices) return {lever};
        return {
            lever,
            std::max(*load.errors.fewerSlices - promised, 0.0) * pixel,
            load.shadowMs * (1 - load.errors.texelShare) / std::max(2.0 * now.slices.value_or(1), 1.0)};
    case Lever::Texels:
        if (!load.errors.fewerTexels) return {lever};
        return {
            lever,
            std::max(*load.errors.fewerTexels - promised, 0.0) * pixel,
            load.shadowMs * load.errors.texelShare / 2};
    case Lever::Resolution:
        return {lever, pixel * (root(1, 4) - 1), pixelMs(load) * (1 - root(-1, 2))};
    case Lever::Exactness:
        if (!load.errors.asMaps) return {lever};
        return {lever, *load.errors.asMaps * pixel, load.shadowMs * (1 - 1 / exactOverMaps_)};
    }
    return {};
}

/// Returns the change of the inverse step: the time and error that `giveUp` would save come back in proportion.
DetailBudget::Change DetailBudget::takeBack(Lever lever, const FrameLoad& load, const Effort& now) const {
    Change change = giveUp(lever, load, now);
    switch (lever) {
    case Lever::Detail:
        change.error /= root(1, 2);
        change.milliseconds *= std::exp2(elasticity_ / 2);
        break;
    case Lever::Slices: // the previous step is assumed to be as expensive as the next one
        change.milliseconds =
            load.shadowMs * (1 - load.errors.texelShare) / std::max(2.0 * now.slices.value_or(1), 1.0);
        change.error = load.errors.promised.value_or(0) / 4;
        break;
    case Lever::Texels:
        change.milliseconds = load.shadowMs * load.errors.texelShare;
        change.error = load.errors.promised.value_or(0) * (1 - root(-1, 2));
        break;
    case Lever::Resolution:
        change.error /= root(1, 4);
        change.milliseconds *= root(1, 2);
        break;
    case Lever::Exactness:
        change.error = load.errors.promised.value_or(0);
        change.milliseconds = load.shadowMs * (exactOverMaps_ - 1);
        break;
    }
    return change;
}

/// Returns the step with the lowest additional error per saved time.
std::optional<DetailBudget::Change> DetailBudget::cheapest(const FrameLoad& load, const Effort& wanted) const {
    const Effort now = effort(wanted);
    std::optional<Change> best;
    for (const Lever lever : kAllLevers) {
        if (step(lever) >= most(lever, wanted)) continue;
        const Change change = giveUp(lever, load, now);
        if (change.milliseconds <= kLeastShare * load.milliseconds) continue;
        if (!best || change.error * best->milliseconds < best->error * change.milliseconds) best = change;
    }
    return best;
}

/// Returns the step back with the largest error reduction per time, among the steps that fit the target.
std::optional<DetailBudget::Change> DetailBudget::dearest(
    const FrameLoad& load, double target, const Effort& wanted) const {
    const Effort now = effort(wanted);
    std::optional<Change> best;
    for (const Lever lever : kAllLevers) {
        if (std::min(step(lever), most(lever, wanted)) <= 0) continue;
        const Change change = takeBack(lever, load, now);
        if (load.milliseconds + change.milliseconds > kComfort * target) continue;
        if (!best || change.error * best->milliseconds > best->error * change.milliseconds) best = change;
    }
    return best;
}

void DetailBudget::learn(const FrameLoad& load) {
    const int steps = step(Lever::Detail) - detailBefore_;
    if (steps != 0 && trianglesBefore_ > 0 && load.triangles > 0) {
        const double octaves = 0.5 * steps;
        const double seen = std::log2(trianglesBefore_ / load.triangles) / octaves;
        elasticity_ += kLearning * (std::clamp(seen, 0.0, 2.0) - elasticity_);
    }
    trianglesBefore_ = load.triangles;
    detailBefore_ = step(Lever::Detail);
    if (load.decidesPoints) {
        exactMs_ = load.shadowMs;
    } else if (exactMs_ > 0 && load.shadowMs > 0) {
        exactOverMaps_ = std::clamp(exactMs_ / load.shadowMs, 1.0, kMaxExactOverMaps);
        exactMs_ = 0;
    }
}

/// Takes quality-reducing steps until the predicted time of `load` is within the target.
void DetailBudget::shed(FrameLoad load, double target, const Effort& wanted) {
    while (load.milliseconds > target) {
        const std::optional<Change> change = cheapest(load, wanted);
        if (!change) return;
        ++step(change->lever);
        const double part = 1 - change->milliseconds / load.milliseconds;
        load.milliseconds -= change->milliseconds;
        if (change->lever == Lever::Resolution) load.pixels *= root(-1, 2);
        if (change->lever == Lever::Detail) load.triangles *= std::exp2(-elasticity_ / 2);
        load.imageMs *= part;
        load.shadowMs *= part;
        load.errors.fewerSlices.reset(); // the errors of the next step are unknown until the next plan
        load.errors.fewerTexels.reset();
        load.errors.asMaps.reset();
    }
}

/// Takes steps back as long as the predicted time is within the target.
void DetailBudget::restore(FrameLoad load, double target, const Effort& wanted) {
    framesWithTime_ = 0;
    while (const std::optional<Change> change = dearest(load, target, wanted)) {
        --step(change->lever);
        load.milliseconds += change->milliseconds;
        if (change->lever == Lever::Slices || change->lever == Lever::Texels || change->lever == Lever::Exactness)
            return; // the time of maps must be measured first
        if (change->lever == Lever::Resolution) load.pixels *= root(1, 2);
        if (change->lever == Lever::Detail) load.triangles *= std::exp2(elasticity_ / 2);
        load.imageMs += change->milliseconds;
    }
}

void DetailBudget::measure(const FrameLoad& load, double target, const Effort& wanted) {
    learn(load);
    const Steps before = steps_;
    const double steady = millisecondsBefore_ > 0 ? std::min(load.milliseconds, millisecondsBefore_) : 0;
    if (steady > kOver * target) {
        FrameLoad scaled = load;
        const double part = steady / load.milliseconds;
        for (double* milliseconds : {&scaled.milliseconds, &scaled.imageMs, &scaled.shadowMs})
            *milliseconds *= part;
        isExhausted_ = !cheapest(scaled, wanted);
        shed(scaled, target, wanted);
        framesWithTime_ = 0;
    } else {
        isExhausted_ = isExhausted_ && load.milliseconds > target;
        framesWithTime_ = dearest(load, target, wanted) ? framesWithTime_ + 1 : 0;
        if (framesWithTime_ >= kFramesToTakeBack) restore(load, target, wanted);
    }
    for (const Lever lever : kAllLevers)
        step(lever) = std::min(step(lever), most(lever, wanted));
    millisecondsBefore_ = steps_ == before ? load.milliseconds : 0;
}

void DetailBudget::relax() {
    *this = {};
}

std::string DetailBudget::givenUp(const Effort& wanted) const {
    const Effort now = effort(wanted);
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
    if (now.errorPixels > wanted.errorPixels)
        add(formatted("detail %.3g -> %.3g px", wanted.errorPixels, now.errorPixels));
    if (now.slices != wanted.slices) add(formatted("slices %d -> %d", *wanted.slices, *now.slices));
    if (now.texelsWidth != wanted.texelsWidth)
        add(formatted(
            "texels %dx%d -> %dx%d", wanted.texelsWidth, wanted.texelsHeight, now.texelsWidth, now.texelsHeight));
    if (now.mayBeExact != wanted.mayBeExact) add("exact shadows");
    if (now.resolution < wanted.resolution)
        add(formatted("resolution %.0f%%", 100 * now.resolution / wanted.resolution));
    return text;
}

} // namespace gnomon::viewer
