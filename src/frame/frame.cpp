#include "core/stopwatch.h"
#include "frame/frame_cuts.h"
#include "frame/frame_row.h"
#include "frame/ground.h"
#include "frame/light_plan.h"
#include "frame/picture_memory.h"
#include "frame/renderer.h"
#include "frame/scene_facts.h"
#include "lod/layers.h"
#include "plan/caster_culling.h"
#include "plan/distant_view.h"
#include "plan/occlusion_choice.h"
#include "plan/shadow_decision.h"
#include "render/light/light_sum.h"
#include "render/ray_shadows.h"

#include <utility>

// The sequence of a frame: residency -> plan -> cut -> cull per partition -> shadow passes -> image pass -> log. For
// exact shadows, and for casters that receivers cull, the backend finds the visible points first and shades them last.

namespace gnomon::frame {

namespace {

/// Shifts the texel grids of all maps. The maps must then be drawn again.
void moveMaps(plan::FramePlan& plan, const glm::dvec2& shift) {
    for (plan::ShadowPass& pass : plan.passes) {
        pass.map.shift = shift;
        pass.isReused = false;
    }
}

telemetry::DrawnDetail detailOf(const PreparedFrame& frame) {
    return {
        frame.plan.quality.errorPixels,
        frame.cut.achievedErrorPixels,
        frame.residency.pagesMissing,
        frame.residency.pagesBlocked > 0};
}

} // namespace

/// Returns the memory of the image that must be reserved: the complete image, or only the sums of an accumulation.
Bytes Renderer::picturePart(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) const {
    if (residency_.holdsPictures()) return pictureBytes(view, quality, options);
    if (!options.isAccumulated) return {};
    const auto pixels = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
    return render::LightSum::bytes(pixels, quality.look.ground, quality.sky.directions > 0);
}

Frame Renderer::render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    const Stopwatch watch;
    plan::Quality meant = quality;
    if (render::isOfMaps(options.overlay)) meant.mapsBecause = plan::ShadowReason::MapsRequested;
    if (!continuesMotion(view, meant)) motion_.isSunless.reset();
    residency_.reservePicture(picturePart(view, meant, options));
    Frame frame{prepare(view, meant, options.waiting, frameBefore(view, meant), options.margin()), options, {}};
    const render::DrawStatistics drawn = drawWithOrWithoutSun(frame);
    if (frame.isSunless) plan::leaveLightSamplingOut(frame.plan);
    if (drawn.exact && drawn.exact->endedEarly)
        frame.plan.omitted.push_back({plan::Effect::LateCasters, plan::OmissionReason::AllAreDark});
    frame.row =
        frameRow(frame, drawn, {model_->path(), backend_->name(), residency_.statistics(), residency_.rayTreeBytes()});
    frame.row.totalMs = watch.elapsed().count;
    shortfall_.add(frame.row);
    motion_.previous = std::make_shared<const plan::PlannedFrame>(plan::PlannedFrame{frame.plan, frame.memory});
    motion_.view = view;
    motion_.quality = meant;
    motion_.farthest = frame.facts.visible ? frame.facts.visible->farthest : 0;
    return frame;
}

void Renderer::chooseOcclusion(PreparedFrame& frame) const {
    const bool isOpen = capabilities().occlusionCulling && frame.plan.quality.occlusion == plan::Choice::Auto;
    const double layers =
        isOpen ? lod::imageLayers(cutQuery(residency_, frame), frame.cut.lists.image, plan::kLeastLayers) : 0;
    plan::chooseOcclusion(frame.plan, layers);
}

void Renderer::planAnew(PreparedFrame& frame, const plan::View& view, const plan::Quality& quality) const {
    const plan::PlanMemory memory = frame.before ? frame.before->memory : plan::PlanMemory{};
    plan::PlannedFrame planned = plan::planFrame(view, quality, frame.facts, memory, capabilities());
    frame.plan = std::move(planned.plan);
    frame.memory = std::move(planned.memory);
    plan::chooseCasterCulling(frame.plan);
    chooseOcclusion(frame);
}

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

PreparedFrame Renderer::prepareShadows(
    const plan::View& view,
    const plan::Quality& asked,
    Waiting waiting,
    const std::shared_ptr<const plan::PlannedFrame>& before,
    double margin) {
    const hierarchy::ModelSummary& model = model_->summary();
    plan::Quality quality = asked;
    quality.shadows = plan::decideShadows(asked, capabilities()).mode;
    residency_.keepRayTrees(quality.shadows == plan::ShadowMode::Rays);
    // time of waiting: all rounds except the cut of the last round, because only waiting causes them
    double streamMs = 0;
    // A cap on triangles searches its error limit among all resident clusters, so it needs the ancestors.
    addTime(streamMs, [&] { residency_.admitLoaded(waiting, quality.maxTriangles.has_value()); });
    for (;;) {
        const Stopwatch round;
        PreparedFrame frame;
        frame.before = before;
        frame.space = render::drawSpace(view, model.grid, model.bounds);
        const std::optional<DepthSpan> range =
            plan::widestRange(view, quality, withGround(model.bounds, ground_.get()));
        frame.errorPixels = quality.errorPixels;
        double surveyedPixels = 0;
        // The loop repeats only if casters increase the error limit under a cap. The facts must come from the clusters
        // that are drawn.
        do {
            addTime(frame.selectMs, [&] { cutImage(frame, {view, margin}, quality, range, residency_, model.grid); });
            surveyedPixels = frame.errorPixels;
            addTime(frame.cullMs, [&] {
                frame.facts =
                    sceneFacts(view, model.bounds, cutQuery(residency_, frame), frame.cut, range, depthScratch_);
                if (quality.shadows == plan::ShadowMode::Exact)
                    frame.facts.isTurnedFromLight = isTurnedFromLight(view, cutQuery(residency_, frame), frame.cut);
                frame.ground = seenGround(ground_, view, model.grid.step(), frame.facts);
            });
            addTime(frame.planMs, [&] { planAnew(frame, view, asked); });
            addTime(frame.cullMs, [&] { cutPartitions(frame, residency_); });
        } while (frame.errorPixels > surveyedPixels);
        const double cutMs = round.elapsed().count;
        frame.residency = residency_.serve(cutQuery(residency_, frame), frame.cut, waiting);
        const bool isLast = waiting == Waiting::Never || !frame.residency.hasChanged;
        streamMs += round.elapsed().count - (isLast ? cutMs : 0);
        frame.streamMs = streamMs;
        if (isLast) return frame;
    }
}

render::DrawStatistics Renderer::draw(PreparedFrame& frame, const FrameOptions& options) {
    moveMaps(frame.plan, options.mapShift);
    heldMaps_.mark(frame, options);
    heldMaps_.clear();
    render::FrameDrawing drawing = this->drawing(frame, options);
    if (frame.hasOneCasterList()) drawing.exactCasters = &frame.cut.lists.casters[0];
    if (frame.isExact()) return backend_->drawExactly(drawing);
    if (frame.isRayTraced()) return render::drawByRays(*backend_, drawing, residency_.rayTrees());
    render::DrawStatistics statistics = backend_->draw(drawing);
    // no visible point needs a shadow computation
    if (frame.plan.quality.shadows == plan::ShadowMode::Exact) statistics.exact.emplace();
    heldMaps_.hold(frame, options, statistics.culled.has_value());
    return statistics;
}

void Renderer::drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options) {
    plan::View view = frame.plan.view;
    view.towardsLight = towardsLight;
    const hierarchy::ModelSummary& model = model_->summary();
    if (options.lightPart == render::LightPart::SkyDirection) view.pointLight.reset();
    // All directions of the sky must use the same ground.
    const bool hasSky = frame.plan.sky.directions > 0;
    ground_ = groundOf(
        hasSky ? frame.plan.view : view, frame.plan.quality.look, {model.bounds, model.grid, model_->pages()}, hasSky);
    PreparedFrame turned = prepareShadows(view, frame.plan.quality, Waiting::UntilComplete, nullptr, options.margin());
    turned.isSunless = frame.isSunless;
    draw(turned, options);
    shortfall_.add(detailOf(turned));
}

void Renderer::drawSample(const PreparedFrame& frame, const FrameOptions& options) {
    render::FrameDrawing drawing = this->drawing(frame, options);
    if (frame.hasOneCasterList()) drawing.exactCasters = &frame.cut.lists.casters[0];
    plan::FramePlan moved;
    if (options.mapShift != glm::dvec2(0) && !frame.plan.passes.empty()) {
        moved = frame.plan;
        moveMaps(moved, options.mapShift);
        drawing.plan = &moved;
        heldMaps_.clear();
        backend_->drawShadowMaps(drawing);
    }
    if (frame.isExact())
        backend_->drawExactly(drawing);
    else if (frame.isRayTraced())
        render::drawByRays(*backend_, drawing, residency_.rayTrees());
    else
        backend_->drawImage(drawing);
}

} // namespace gnomon::frame
