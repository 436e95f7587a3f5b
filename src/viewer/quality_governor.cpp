#include "viewer/quality_governor.h"

#include "core/formatted.h"
#include "plan/plan_frame.h"

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

constexpr std::array kAllQualityKinds = {
    QualityKind::Detail, QualityKind::Slices, QualityKind::Texels, QualityKind::Resolution, QualityKind::Exactness};
constexpr int kDetailSteps = 8;         // half octaves: up to 16 times the error
constexpr int kTexelSteps = 4;          // down to a sixteenth of the texels
constexpr int kResolutionSteps = 4;     // quarter octaves of a side: down to half the resolution
constexpr double kOverload = 1.03;      // as a multiple of the target; longer frames count as too slow
constexpr double kRestoreMargin = 0.85; // as a multiple of the target; max predicted time after a step back
constexpr int kFramesToRestore = 12;
constexpr double kTrianglesPerPixel = 1; // shading cost of a pixel, in drawn triangles
constexpr double kMinShare = 0.005;      // min time that a step must save, as a share of the frame time
constexpr double kLearning = 0.3;
constexpr double kMaxExactOverMaps = 16;

double root(int steps, double perOctave) {
    return std::exp2(steps / perOctave);
}

std::optional<double> largest(const plan::FramePlan& plan) {
    if (plan.passes.empty()) return std::nullopt;
    return std::max(plan.aliasingBound.x, plan.aliasingBound.z);
}

} // namespace

ShadowErrors shadowErrors(const plan::FramePlan& plan, const plan::SceneFacts& facts, bool withLess) {
    ShadowErrors errors;
    errors.aliasingBound = largest(plan);
    if (withLess && plan.quality.shadows == plan::ShadowMode::Exact &&
        plan.shadowReason != plan::ShadowReason::Requested && !plan.view.pointLight) {
        plan::Quality maps = plan.quality;
        maps.shadows = plan::ShadowMode::Maps;
        errors.withMaps = largest(plan::planFrame(plan.view, maps, facts, {}, plan.backend).plan);
    }
    if (!errors.aliasingBound) return errors;
    const double texels = static_cast<double>(plan.textureWidth) * plan.textureHeight / 16;
    errors.texelShare = texels / std::max(static_cast<double>(plan.cost), texels);
    if (!withLess) return errors;
    const auto boundWith = [&](const plan::Quality& quality) {
        return largest(plan::planFrame(plan.view, quality, facts, {}, plan.backend).plan);
    };
    plan::Quality fewer = plan.quality;
    if (fewer.zPartitions.value_or(1) > 1) {
        --*fewer.zPartitions;
        errors.fewerSlices = boundWith(fewer);
    }
    fewer = plan.quality;
    fewer.shadowTexelsHeight = std::max(fewer.shadowTexelsHeight / 2, 1);
    errors.fewerTexels = boundWith(fewer);
    return errors;
}

int QualityGovernor::maxSteps(QualityKind kind, const QualityLevel& wanted) {
    switch (kind) {
    case QualityKind::Detail:
        return kDetailSteps;
    case QualityKind::Slices:
        return wanted.slices.value_or(1) - 1;
    case QualityKind::Texels:
        return kTexelSteps;
    case QualityKind::Resolution:
        return kResolutionSteps;
    case QualityKind::Exactness:
        return wanted.mayBeExact ? 1 : 0;
    }
    return 0;
}

QualityLevel QualityGovernor::levelAt(const Steps& steps, const QualityLevel& wanted) {
    const auto of = [&](QualityKind kind) {
        return std::min(steps[static_cast<std::size_t>(kind)], maxSteps(kind, wanted));
    };
    QualityLevel level = wanted;
    level.errorPixels = wanted.errorPixels * root(of(QualityKind::Detail), 2);
    if (wanted.slices) level.slices = *wanted.slices - of(QualityKind::Slices);
    const double side = root(-of(QualityKind::Texels), 2);
    level.texelsWidth = std::max(static_cast<int>(std::lround(wanted.texelsWidth * side)), 1);
    level.texelsHeight = std::max(static_cast<int>(std::lround(wanted.texelsHeight * side)), 1);
    level.resolution = wanted.resolution * root(-of(QualityKind::Resolution), 4);
    level.mayBeExact = wanted.mayBeExact && of(QualityKind::Exactness) == 0;
    return level;
}

QualityLevel QualityGovernor::level(const QualityLevel& wanted) const {
    return levelAt(steps_, wanted);
}

/// Returns the part of the frame time that is proportional to the number of triangles, in milliseconds. It includes the
/// triangles of shadows.
double QualityGovernor::detailMs(const FrameLoad& load) const {
    const double work = load.triangles + kTrianglesPerPixel * load.pixels;
    const double ofImage = work > 0 ? load.imageMs * load.triangles / work : 0;
    return ofImage + load.shadowMs * (load.resolvesPoints ? 0.5 : 1 - load.errors.texelShare);
}

/// Returns the part of the frame time that is proportional to the number of pixels, in milliseconds.
double QualityGovernor::pixelMs(const FrameLoad& load) const {
    const double work = load.triangles + kTrianglesPerPixel * load.pixels;
    const double ofImage = work > 0 ? load.imageMs * kTrianglesPerPixel * load.pixels / work : 0;
    return ofImage + (load.resolvesPoints ? 0.5 * load.shadowMs : 0);
}

QualityGovernor::Change QualityGovernor::reduction(
    QualityKind kind, const FrameLoad& load, const QualityLevel& now) const {
    const double pixel = 1 / now.resolution; // size of a drawn pixel in pixels of the window
    const double aliasingBound = load.errors.aliasingBound.value_or(0);
    switch (kind) {
    case QualityKind::Detail:
        return {kind, now.errorPixels * (root(1, 2) - 1), detailMs(load) * (1 - std::exp2(-elasticity_ / 2))};
    case QualityKind::Slices:
        if (!load.errors.fewerSlices) return {kind};
        return {
            kind,
            std::max(*load.errors.fewerSlices - aliasingBound, 0.0) * pixel,
            load.shadowMs * (1 - load.errors.texelShare) / std::max(2.0 * now.slices.value_or(1), 1.0)};
    case QualityKind::Texels:
        if (!load.errors.fewerTexels) return {kind};
        return {
            kind,
            std::max(*load.errors.fewerTexels - aliasingBound, 0.0) * pixel,
            load.shadowMs * load.errors.texelShare / 2};
    case QualityKind::Resolution:
        return {kind, pixel * (root(1, 4) - 1), pixelMs(load) * (1 - root(-1, 2))};
    case QualityKind::Exactness:
        if (!load.errors.withMaps) return {kind};
        return {kind, *load.errors.withMaps * pixel, load.shadowMs * (1 - 1 / exactOverMaps_)};
    }
    return {};
}

/// Returns the effect of one step to higher quality of `kind`: the error that it removes, and the time that it adds.
/// Both are estimated from the effect of the next reduction of this kind.
QualityGovernor::Change QualityGovernor::restoration(
    QualityKind kind, const FrameLoad& load, const QualityLevel& now) const {
    Change change = reduction(kind, load, now);
    switch (kind) {
    case QualityKind::Detail:
        change.error /= root(1, 2);
        change.milliseconds *= std::exp2(elasticity_ / 2);
        break;
    case QualityKind::Slices: // assumes that both steps take the same time
        change.milliseconds =
            load.shadowMs * (1 - load.errors.texelShare) / std::max(2.0 * now.slices.value_or(1), 1.0);
        change.error = load.errors.aliasingBound.value_or(0) / 4;
        break;
    case QualityKind::Texels:
        change.milliseconds = load.shadowMs * load.errors.texelShare;
        change.error = load.errors.aliasingBound.value_or(0) * (1 - root(-1, 2));
        break;
    case QualityKind::Resolution:
        change.error /= root(1, 4);
        change.milliseconds *= root(1, 2);
        break;
    case QualityKind::Exactness:
        change.error = load.errors.aliasingBound.value_or(0);
        change.milliseconds = load.shadowMs * (exactOverMaps_ - 1);
        break;
    }
    return change;
}

/// Returns the quality reduction with the smallest error per saved time.
std::optional<QualityGovernor::Change> QualityGovernor::cheapest(
    const FrameLoad& load, const QualityLevel& wanted) const {
    const QualityLevel now = level(wanted);
    std::optional<Change> best;
    for (const QualityKind kind : kAllQualityKinds) {
        if (step(kind) >= maxSteps(kind, wanted)) continue;
        const Change change = reduction(kind, load, now);
        if (change.milliseconds <= kMinShare * load.milliseconds) continue;
        if (!best || change.error * best->milliseconds < best->error * change.milliseconds) best = change;
    }
    return best;
}

/// Returns the step to higher quality that removes the largest error per added time. Only steps count after which the
/// frame time stays within the target.
std::optional<QualityGovernor::Change> QualityGovernor::costliest(
    const FrameLoad& load, double target, const QualityLevel& wanted) const {
    const QualityLevel now = level(wanted);
    std::optional<Change> best;
    for (const QualityKind kind : kAllQualityKinds) {
        if (std::min(step(kind), maxSteps(kind, wanted)) <= 0) continue;
        const Change change = restoration(kind, load, now);
        if (load.milliseconds + change.milliseconds > kRestoreMargin * target) continue;
        if (!best || change.error * best->milliseconds > best->error * change.milliseconds) best = change;
    }
    return best;
}

void QualityGovernor::learn(const FrameLoad& load) {
    const int steps = step(QualityKind::Detail) - detailBefore_;
    if (steps != 0 && trianglesBefore_ > 0 && load.triangles > 0) {
        const double octaves = 0.5 * steps;
        const double seen = std::log2(trianglesBefore_ / load.triangles) / octaves;
        elasticity_ += kLearning * (std::clamp(seen, 0.0, 2.0) - elasticity_);
    }
    trianglesBefore_ = load.triangles;
    detailBefore_ = step(QualityKind::Detail);
    if (load.resolvesPoints) {
        exactMs_ = load.shadowMs;
    } else if (exactMs_ > 0 && load.shadowMs > 0) {
        exactOverMaps_ = std::clamp(exactMs_ / load.shadowMs, 1.0, kMaxExactOverMaps);
        exactMs_ = 0;
    }
}

/// Reduces the quality in steps until the predicted time of `load` is within the target.
void QualityGovernor::reduce(FrameLoad load, double target, const QualityLevel& wanted) {
    while (load.milliseconds > target) {
        const std::optional<Change> change = cheapest(load, wanted);
        if (!change) return;
        ++step(change->kind);
        const double part = 1 - change->milliseconds / load.milliseconds;
        load.milliseconds -= change->milliseconds;
        if (change->kind == QualityKind::Resolution) load.pixels *= root(-1, 2);
        if (change->kind == QualityKind::Detail) load.triangles *= std::exp2(-elasticity_ / 2);
        load.imageMs *= part;
        load.shadowMs *= part;
        load.errors.fewerSlices.reset(); // unknown until the next plan
        load.errors.fewerTexels.reset();
        load.errors.withMaps.reset();
    }
}

/// Restores the quality in steps as long as the predicted frame time is within the target.
void QualityGovernor::restore(FrameLoad load, double target, const QualityLevel& wanted) {
    framesWithTime_ = 0;
    while (const std::optional<Change> change = costliest(load, target, wanted)) {
        --step(change->kind);
        load.milliseconds += change->milliseconds;
        if (change->kind == QualityKind::Slices || change->kind == QualityKind::Texels ||
            change->kind == QualityKind::Exactness)
            return; // the effect on the time of shadow maps must be measured first
        if (change->kind == QualityKind::Resolution) load.pixels *= root(1, 2);
        if (change->kind == QualityKind::Detail) load.triangles *= std::exp2(elasticity_ / 2);
        load.imageMs += change->milliseconds;
    }
}

void QualityGovernor::measure(const FrameLoad& load, double target, const QualityLevel& wanted) {
    learn(load);
    const Steps before = steps_;
    const double steady = millisecondsBefore_ > 0 ? std::min(load.milliseconds, millisecondsBefore_) : 0;
    if (steady > kOverload * target) {
        FrameLoad scaled = load;
        const double part = steady / load.milliseconds;
        for (double* milliseconds : {&scaled.milliseconds, &scaled.imageMs, &scaled.shadowMs})
            *milliseconds *= part;
        isExhausted_ = !cheapest(scaled, wanted);
        reduce(scaled, target, wanted);
        framesWithTime_ = 0;
    } else {
        isExhausted_ = isExhausted_ && load.milliseconds > target;
        framesWithTime_ = costliest(load, target, wanted) ? framesWithTime_ + 1 : 0;
        if (framesWithTime_ >= kFramesToRestore) restore(load, target, wanted);
    }
    for (const QualityKind kind : kAllQualityKinds)
        step(kind) = std::min(step(kind), maxSteps(kind, wanted));
    millisecondsBefore_ = steps_ == before ? load.milliseconds : 0;
}

void QualityGovernor::relax() {
    *this = {};
}

std::string QualityGovernor::reductions(const QualityLevel& wanted) const {
    const QualityLevel now = level(wanted);
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
