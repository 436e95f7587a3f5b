#include "core/stopwatch.h"
#include "frame/exact_forecast.h"
#include "frame/light_plan.h"
#include "frame/renderer.h"
#include "plan/distant_view.h"

// Whether a frame whose shadows are left open gets exact ones or maps. Exact ones are prepared to be asked: where they
// are chosen nothing was done in vain but the prediction.

namespace gnomon::frame {

namespace {

plan::Quality with(const plan::Quality& quality, plan::ShadowMode mode) {
    plan::Quality result = quality;
    result.shadows = mode;
    result.mapsBecause.reset();
    return result;
}

void addPreparation(PreparedFrame& frame, const PreparedFrame& other) {
    frame.planMs += other.planMs;
    frame.selectMs += other.selectMs;
    frame.cullMs += other.cullMs;
    frame.streamMs += other.streamMs;
}

} // namespace

PreparedFrame Renderer::prepare(
    const plan::View& view,
    const plan::Quality& quality,
    Waiting waiting,
    const std::shared_ptr<const plan::PlannedFrame>& before,
    double margin) {
    const hierarchy::ModelSummary& model = model_->summary();
    ground_ = groundOf(view, quality.look, {model.bounds, model.grid, model_->pages()}, quality.sky.directions > 0);
    const plan::View distant = plan::distantView(view, withGround(model.bounds, ground_.get()));
    PreparedFrame frame =
        prepareShadows(distant, plan::distantQuality(quality, view, distant), waiting, before, margin);
    addTime(frame.planMs, [&] { planLightSampling(frame, residency_); });
    return frame;
}

PreparedFrame Renderer::prepareForPoint(
    const plan::View& view,
    const plan::Quality& quality,
    Waiting waiting,
    const std::shared_ptr<const plan::PlannedFrame>& before,
    double margin) {
    using plan::ShadowMode;
    const bool isWithout = plan::isWithoutSun(quality.look.shading);
    const auto prepared = [&](ShadowMode mode, plan::ShadowReason reason) {
        PreparedFrame frame = prepareAs(view, with(quality, mode), waiting, before, margin);
        frame.plan.shadowReason = reason;
        return frame;
    };
    if (quality.shadows != ShadowMode::Auto) return prepared(quality.shadows, plan::ShadowReason::AskedFor);
    if (isWithout) return prepared(ShadowMode::Off, plan::ShadowReason::NoSun);
    if (quality.mapsBecause) return prepared(ShadowMode::Maps, *quality.mapsBecause);
    if (!executor_->capabilities().exactShadows) return prepared(ShadowMode::Maps, plan::ShadowReason::ExecutorHasMaps);
    return prepared(ShadowMode::Exact, plan::ShadowReason::PointLight);
}

PreparedFrame Renderer::prepareShadows(
    const plan::View& view,
    const plan::Quality& quality,
    Waiting waiting,
    const std::shared_ptr<const plan::PlannedFrame>& before,
    double margin) {
    using plan::ShadowMode;
    using plan::ShadowReason;
    const auto prepared = [&](ShadowMode mode) {
        return prepareAs(view, with(quality, mode), waiting, before, margin);
    };
    const auto predict = [&](PreparedFrame& frame) {
        if (!estimate_) estimate_ = std::make_shared<ExactEstimate>();
        addTime(frame.planMs, [&] {
            frame.plan.predicted = predictedWork(frame, drawing(frame, {}), residency_, *estimate_);
        });
    };
    const auto asMaps = [&](ShadowReason reason) {
        PreparedFrame frame = prepared(ShadowMode::Maps);
        frame.plan.shadowReason = reason;
        return frame;
    };
    if (view.pointLight) return prepareForPoint(view, quality, waiting, before, margin);
    std::optional<plan::ModeMemory> memory = before ? before->memory.mode : std::nullopt;
    if (memory && memory->isAskedFor != (quality.shadows == ShadowMode::Exact)) memory.reset();
    const std::optional<plan::ModeMemory> held = plan::withoutCosts(memory);
    if (quality.shadows != ShadowMode::Auto) {
        PreparedFrame frame = prepared(quality.shadows);
        if (quality.shadows != ShadowMode::Exact) return frame;
        frame.memory.mode = held.value_or(plan::ModeMemory{.isExact = true, .isAskedFor = true});
        if (!held) predict(frame);
        return frame;
    }
    if (plan::isWithoutSun(quality.look.shading)) {
        PreparedFrame frame = prepared(ShadowMode::Off);
        frame.plan.shadowReason = ShadowReason::NoSun;
        return frame;
    }
    if (quality.mapsBecause) return asMaps(*quality.mapsBecause);
    if (!executor_->capabilities().exactShadows) return asMaps(ShadowReason::ExecutorHasMaps);
    if (held) {
        PreparedFrame frame = prepared(held->isExact ? ShadowMode::Exact : ShadowMode::Maps);
        frame.plan.shadowReason = ShadowReason::Held;
        frame.memory.mode = held;
        return frame;
    }
    PreparedFrame exact = prepared(ShadowMode::Exact);
    predict(exact);
    const plan::ShadowChoice choice = plan::choiceByCosts(plan::shadowCosts(*exact.plan.predicted), memory);
    const bool isExact = choice.mode == ShadowMode::Exact;
    PreparedFrame maps;
    if (!isExact) {
        maps = prepared(choice.mode);
        addPreparation(maps, exact);
        maps.plan.predicted = exact.plan.predicted;
    }
    PreparedFrame frame = std::move(isExact ? exact : maps);
    frame.plan.shadowReason = choice.reason;
    frame.memory.mode = choice.memory;
    return frame;
}

} // namespace gnomon::frame
