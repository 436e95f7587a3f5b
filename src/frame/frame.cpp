#include "core/stopwatch.h"
#include "frame/frame_cuts.h"
#include "frame/frame_row.h"
#include "frame/ground.h"
#include "frame/light_plan.h"
#include "frame/picture_memory.h"
#include "frame/renderer.h"
#include "frame/scene_facts.h"
#include "lod/layers.h"
#include "plan/distant_view.h"
#include "plan/occlusion_choice.h"
#include "plan/shadow_decision.h"
#include "render/light/light_sum.h"
#include "render/ray_shadows.h"

#include <utility>

// A frame is computed in these steps: scene facts, choice of the shadows, plan, selection of clusters, drawing, log
// row. Each step uses only the results of the steps before it. `planFrame` makes the choices that need the scene facts.
// `decideMapReuse` and `decideHeadlight` make the choices that need the previous frame.

namespace gnomon::frame {

namespace {

/// Shifts the texel grids of all shadow maps by `shift` texels. All maps must then be drawn again.
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

/// Returns true if certainly no visible surface faces the light.
bool isTurnedAway(const plan::SceneFacts& facts) {
    return facts.isTurnedFromLight || (facts.light && facts.light->lit.empty());
}

/// Returns true if counting the lit pixels of `frame` can tell whether Shading::Auto uses the headlight.
bool canCountLitPixels(const Frame& frame) {
    return !frame.options.observerCamera && frame.facts.visible && frame.facts.visible->anything;
}

/// Chooses between the sun and the headlight before drawing. The first frame of a camera motion chooses for the whole
/// motion, so that the shading does not switch. If neither the history nor the scene facts determine the choice, the
/// function sets `asksLitPixels`.
void decideHeadlight(Frame& frame) {
    std::optional<bool>& usesHeadlight = frame.history.usesHeadlight;
    usesHeadlight = frame.before.usesHeadlight;
    if (frame.plan.quality.look.shading != plan::Shading::Auto) return;
    if (!usesHeadlight && frame.hasGround) usesHeadlight = false; // on the ground, only shadows of the sun are visible
    if (!usesHeadlight && canCountLitPixels(frame)) {
        if (isTurnedAway(frame.facts)) usesHeadlight = true;
        frame.asksLitPixels = !usesHeadlight;
    }
    frame.usesHeadlight = !frame.hasGround && usesHeadlight.value_or(false);
}

} // namespace

/// Returns the memory that must be reserved for the image: for the complete image, or only for the sums of an image
/// that is the mean of several frames.
Bytes Renderer::picturePart(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) const {
    if (residency_.holdsPictures()) return pictureBytes(view, quality, options);
    if (!options.isAccumulated) return {};
    const auto pixels = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
    return render::LightSum::bytes(pixels, quality.look.ground, quality.sky.directions > 0);
}

Frame Renderer::render(
    const plan::View& view, const plan::Quality& quality, const FrameOptions& options, const History& history) {
    const Stopwatch watch;
    plan::Quality meant = quality;
    if (render::isOfMaps(options.overlay)) meant.mapsBecause = plan::ShadowReason::MapsRequested;
    const History before = continuedHistory(history, view, meant);
    residency_.reservePicture(picturePart(view, meant, options));
    Frame frame{prepare(view, meant, options.waiting, before.memory(), options.margin()), options, before, {}, {}};
    decideHeadlight(frame);
    const render::DrawStatistics drawn = drawInLight(frame);
    frame.row =
        frameRow(frame, drawn, {model_->path(), backend_->name(), residency_.statistics(), residency_.rayTreeBytes()});
    frame.row.totalMs = watch.elapsed().count;
    shortfall_.add(frame.row);
    frame.history.previous = std::make_shared<const plan::PlannedFrame>(plan::PlannedFrame{frame.plan, frame.memory});
    frame.history.view = view;
    frame.history.quality = meant;
    frame.history.farthest = frame.facts.visible ? frame.facts.visible->farthest : 0;
    frame.history.maps = maps_;
    return frame;
}

PreparedFrame Renderer::prepare(
    const plan::View& view,
    const plan::Quality& quality,
    Waiting waiting,
    const plan::PlanMemory& memory,
    double margin) {
    const std::shared_ptr<const Ground> ground = this->ground(view, quality.look, quality.sky.directions > 0);
    const plan::View distant = plan::distantView(view, withGround(model_->summary().bounds, ground.get()));
    const plan::Quality distantQuality = plan::distantQuality(quality, view, distant);
    PreparedFrame frame = prepareShadows({distant, distantQuality, ground, memory, waiting, margin});
    addTime(frame.planMs, [&] { planLightSampling(frame, residency_); });
    return frame;
}

/// Plans the frame and selects its clusters repeatedly, until all their pages are in memory. The ground of the frame is
/// given. The result has no penumbrae and no sky light yet.
PreparedFrame Renderer::prepareShadows(const Asked& asked) {
    const plan::ShadowMode shadows = plan::chooseShadows(asked.quality, capabilities()).mode;
    residency_.keepRayTrees(shadows == plan::ShadowMode::Rays);
    // total time except the last selection of clusters, in milliseconds; it is caused by waiting for pages
    double streamMs = 0;
    // With a cap on the number of triangles, the error limit is searched among all clusters in memory. The search
    // therefore needs the coarser ancestors of the pages.
    addTime(streamMs, [&] { residency_.admitLoaded(asked.waiting, asked.quality.maxTriangles.has_value()); });
    for (;;) {
        const Stopwatch round;
        PreparedFrame frame = planned(asked, shadows);
        const double cutMs = round.elapsed().count;
        frame.residency = residency_.serve(cutQuery(residency_, frame), frame.cut, asked.waiting);
        const bool isLast = asked.waiting == Waiting::Never || !frame.residency.hasChanged;
        streamMs += round.elapsed().count - (isLast ? cutMs : 0);
        frame.streamMs = streamMs;
        if (isLast) return frame;
    }
}

/// Computes the scene facts, the plan and the selected clusters of a frame from the pages that are in memory now.
/// `shadows` is the type of shadows, not Auto.
PreparedFrame Renderer::planned(const Asked& asked, plan::ShadowMode shadows) {
    const hierarchy::ModelSummary& model = model_->summary();
    plan::Quality decided = asked.quality;
    decided.shadows = shadows;
    const std::optional<DepthSpan> range =
        plan::widestRange(asked.view, decided, withGround(model.bounds, asked.ground.get()));
    PreparedFrame frame;
    frame.space = render::cameraRelativeSpace(asked.view, model.grid, model.bounds);
    frame.hasGround = asked.ground != nullptr;
    frame.errorPixels = decided.errorPixels;
    double factsPixels = 0;
    // The loop repeats only if the casters increase the error limit because of a cap on triangles. The scene facts must
    // then be computed again from the new selection of clusters, because this selection is drawn.
    do {
        addTime(frame.selectMs, [&] {
            cutImage(frame, {asked.view, asked.margin}, decided, range, residency_, model.grid);
        });
        factsPixels = frame.errorPixels;
        addTime(frame.cullMs, [&] { findFacts(frame, asked, shadows, range); });
        addTime(frame.planMs, [&] {
            plan::PlannedFrame planned =
                plan::planFrame(asked.view, asked.quality, frame.facts, asked.memory, capabilities());
            frame.plan = std::move(planned.plan);
            frame.memory = std::move(planned.memory);
        });
        addTime(frame.cullMs, [&] { cutPartitions(frame, residency_); });
    } while (frame.errorPixels > factsPixels);
    return frame;
}

/// Computes the scene facts and the visible ground of `frame` from the first selection of clusters.
void Renderer::findFacts(
    PreparedFrame& frame, const Asked& asked, plan::ShadowMode shadows, const std::optional<DepthSpan>& range) {
    const hierarchy::ModelSummary& model = model_->summary();
    const lod::CutQuery query = cutQuery(residency_, frame);
    frame.facts = sceneFacts(asked.view, model.bounds, query, frame.cut, range, depthScratch_);
    if (shadows == plan::ShadowMode::Exact)
        frame.facts.isTurnedFromLight = isTurnedFromLight(asked.view, query, frame.cut);
    if (capabilities().occlusionCulling && asked.quality.occlusion == plan::Choice::Auto)
        frame.facts.layers = lod::imageLayers(query, frame.cut.lists.image, plan::kMinLayers);
    frame.ground = seenGround(asked.ground, asked.view, model.grid.step(), frame.facts);
}

std::shared_ptr<const Ground> Renderer::ground(
    const plan::View& view, const plan::ShadingSettings& look, bool hasSky) const {
    const hierarchy::ModelSummary& model = model_->summary();
    return groundOf(view, look, {model.bounds, model.grid, model_->pages()}, hasSky);
}

render::DrawStatistics Renderer::draw(
    PreparedFrame& frame, const FrameOptions& options, const std::shared_ptr<const DrawnMaps>& maps) {
    moveMaps(frame.plan, options.mapShift);
    decideMapReuse(frame, options, maps == maps_ ? maps.get() : nullptr);
    maps_.reset();
    render::DrawInputs drawing = this->drawing(frame, options);
    if (frame.asksLitPixels) drawing.minLitPixels = minLitPixels(frame.plan.view);
    if (frame.isExact()) return backend_->drawExactly(drawing);
    if (frame.isRayTraced()) return render::drawByRays(*backend_, drawing, residency_.rayTrees());
    render::DrawStatistics statistics = backend_->draw(drawing);
    // No visible point needs an exact shadow test, but the statistics of exact shadows must exist.
    if (frame.plan.quality.shadows == plan::ShadowMode::Exact) statistics.exact.emplace();
    if (!frame.plan.passes.empty())
        maps_ = std::make_shared<const DrawnMaps>(
            DrawnMaps{frame.plan, mappedImage(frame, options), statistics.culled.has_value()});
    return statistics;
}

/// Draws `frame` with the sun or the headlight. If the number of lit pixels must decide, and the sun reaches almost no
/// pixel, draws the image again with the headlight. With exact shadows, this number is known before the shading, so the
/// image is drawn only once.
render::DrawStatistics Renderer::drawInLight(Frame& frame) {
    if (frame.usesHeadlight) plan::skipLightSampling(frame.plan);
    render::DrawStatistics drawn = draw(frame, frame.options, frame.before.maps);
    if (drawn.exact && drawn.exact->endedEarly)
        frame.plan.omitted.push_back({plan::Effect::LateCasters, plan::SkipReason::AllAreDark});
    if (!std::exchange(frame.asksLitPixels, false)) return drawn;
    const std::optional<std::uint64_t> litPixels = backend_->litPixels();
    if (!litPixels) return drawn;
    frame.usesHeadlight = isNegligible(*litPixels, frame.plan.view);
    frame.history.usesHeadlight = frame.usesHeadlight;
    if (!frame.usesHeadlight) return drawn;
    plan::skipLightSampling(frame.plan);
    if (drawn.isHeadlit) return drawn;
    if (frame.hasOneCasterList()) return draw(frame, frame.options);
    // Only the image is drawn again, because the headlight needs no shadow maps.
    const Milliseconds first = drawn.image.time;
    drawn.image = backend_->drawImage(drawing(frame, frame.options));
    drawn.image.time.count += first.count;
    return drawn;
}

void Renderer::drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options) {
    plan::View view = frame.plan.view;
    view.towardsLight = towardsLight;
    if (options.lightPart == render::LightPart::SkyDirection) view.pointLight.reset();
    // All light directions of an image with sky light must use the same ground.
    const bool hasSky = frame.plan.sky.directions > 0;
    const std::shared_ptr<const Ground> ground =
        this->ground(hasSky ? frame.plan.view : view, frame.plan.quality.look, hasSky);
    const plan::PlanMemory none;
    PreparedFrame turned =
        prepareShadows({view, frame.plan.quality, ground, none, Waiting::UntilComplete, options.margin()});
    turned.usesHeadlight = frame.usesHeadlight;
    draw(turned, options);
    shortfall_.add(detailOf(turned));
}

void Renderer::drawSample(const PreparedFrame& frame, const FrameOptions& options) {
    render::DrawInputs drawing = this->drawing(frame, options);
    plan::FramePlan moved;
    if (options.mapShift != glm::dvec2(0) && !frame.plan.passes.empty()) {
        moved = frame.plan;
        moveMaps(moved, options.mapShift);
        drawing.plan = &moved;
        maps_.reset();
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
