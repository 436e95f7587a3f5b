#include "culling/frame_cut.h"
#include "executor/ray_shadows.h"
#include "frame/prepared_frame.h"
#include "shadow/caster_volume.h"

#include <algorithm>
#include <array>

// What a frame's shadows are held against: rays, and the promise of the plan.

namespace gnomon::frame {

namespace {

/// The frustum of all that is drawn, whatever range the shadows are promised for.
shadow::ViewFrustum visibleFrustum(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    double near = plan.near;
    double far = plan.far;
    if (facts.visible && facts.visible->anything) {
        near = std::min(near, facts.visible->nearest);
        far = std::max(far, facts.visible->farthest);
    }
    constexpr double kLeastRatio = 1e-9; // a frustum wants a near plane
    return {std::max(near, kLeastRatio * far), far, plan.view.camera.fovYRadians / 2, plan.view.aspect()};
}

shadow::Region wholeRegion(const plan::FramePlan& plan, const plan::SceneFacts& facts) {
    const shadow::ViewFrustum frustum = visibleFrustum(plan, facts);
    const auto selector =
        shadow::partitionSelector(frustum, plan.towardsLight, {frustum.near, frustum.far}, false, false);
    return shadow::partitionRegion(frustum, selector, 0);
}

} // namespace

ConvexVolume Renderer::rayCasterVolume(const Prepared& prepared) const {
    const plan::FramePlan& plan = prepared.plan;
    const shadow::Region region = wholeRegion(plan, prepared.facts);
    return culling::localVolume(
        shadow::casterVolume(region, shadow::lightFrame(plan.towardsLight)), prepared.rule->view());
}

selection::CasterDetail Renderer::rayCasterDetail(const Prepared& prepared) const {
    const plan::FramePlan& plan = prepared.plan;
    const shadow::Region region = wholeRegion(plan, prepared.facts);
    selection::CasterDetail detail; // without texels
    detail.casters = rayCasterVolume(prepared);
    detail.receivers = culling::localVolume(region.volume, prepared.rule->view());
    detail.receiverNear = region.frustum.near;
    detail.towardsLight = toWorld(plan.basis, plan.towardsLight);
    return detail;
}

executor::DrawStatistics Renderer::draw(const Prepared& prepared, const executor::FrameDrawing& drawing) {
    heldMaps_.reset();
    if (prepared.isRayTraced()) return executor::drawWithRays(*executor_, drawing, prepared.cut.lists[1]);
    const executor::DrawStatistics statistics = executor_->draw(drawing);
    heldMaps_.emplace().plan = prepared.plan;
    for (const selection::DrawList* casters : drawing.casters)
        heldMaps_->casters.push_back(casters->ranges);
    return statistics;
}

void Renderer::prove(const Prepared& prepared, const FrameOptions& options, Frame& frame) {
    const bool hasOracle = options.oracle != Oracle::None && !prepared.plan.passes.empty();
    const bool isMeasured = options.measuresAliasing && !prepared.plan.passes.empty();
    const bool hasCrawl =
        options.measuresCrawl && !prepared.plan.passes.empty() && previous_ && !previous_->passes.empty();
    if (options.onlooker || !(hasOracle || isMeasured || hasCrawl || options.comparesWithFinest)) return;
    FrameOptions plain = options;
    plain.overlay = executor::Overlay::None;
    plain.wantsSurfaces = hasOracle || isMeasured || hasCrawl;
    const executor::FrameDrawing again = drawing(prepared, plain);
    draw(prepared, again);
    const executor::Picture picture = executor_->picture();
    const executor::FloatPicture maps = hasCrawl ? executor_->shadowDepth() : executor::FloatPicture();
    if (isMeasured) {
        frame.aliasing = proof::measuredAliasing(again, executor_->surfaces());
        frame.row.measuredAliasing = frame.aliasing->worst();
    }
    if (hasOracle) {
        frame.truth = truth(prepared, again, options.oracle);
        frame.row.wrongShadowFraction = frame.truth->answerable.wrongFraction;
        frame.row.shadowEdgeP99Px = frame.truth->answerable.edgeP99Pixels;
        frame.row.missedShadowFraction = frame.truth->missedFraction();
        frame.row.unexplainedShadowFraction = frame.truth->unexplainedFraction();
    }
    if (options.comparesWithFinest) {
        const Prepared fine = finest(prepared);
        draw(fine, drawing(fine, plain));
        frame.row.imageDifference = executor::difference(executor_->picture(), picture).mean;
    }
    if (hasCrawl) {
        frame.crawl = crawlSince(*previous_, again, maps);
        frame.row.crawl = frame.crawl->share();
    }
    // What the executor shows is the frame that was asked for, and its pages are there.
    const Prepared asked = prepare(prepared.plan.view, prepared.plan.quality, options.waiting);
    draw(asked, drawing(asked, options));
}

proof::ShadowTruth Renderer::truth(const Prepared& prepared, const executor::FrameDrawing& drawing, Oracle oracle) {
    const executor::Raster<executor::SurfaceSample> surfaces = executor_->surfaces();
    if (oracle == Oracle::FullDetail) {
        const Prepared fine = finest(prepared);
        const std::array lists = {&fine.cut.lists[0], &fine.cut.lists[1]};
        const raycast::Scene scene = executor::rayScene(drawing, lists);
        // The true surface may lie as far from the drawn one as the cut allows.
        const auto light = executor::lightByRays(
            scene, prepared.plan, drawing.space, surfaces, std::max(executor::kTouchingPixels, prepared.errorPixels));
        return proof::shadowTruth(scene, drawing, surfaces, light);
    }
    // The same rule decides as for the maps, so every cluster is the one that they drew; the volume alone is wider.
    const std::array volumes = {prepared.volumes[0], rayCasterVolume(prepared)};
    selection::CutQuery wider = query(prepared);
    wider.volumes = volumes;
    const selection::Cut cut = selection::cut(wider);
    const std::array lists = {drawing.image, &cut.lists[1]};
    const raycast::Scene scene = executor::rayScene(drawing, lists);
    const auto light = executor::lightByRays(scene, prepared.plan, drawing.space, surfaces, executor::kTouchingPixels);
    return proof::shadowTruth(scene, drawing, surfaces, light);
}

/// Draws the frame before once more: a plan is steady when its own view comes again.
proof::Crawl Renderer::crawlSince(
    const plan::FramePlan& before, const executor::FrameDrawing& now, const executor::FloatPicture& maps) {
    const Prepared prepared = prepare(before.view, before.quality, Waiting::UntilComplete);
    FrameOptions options;
    options.wantsSurfaces = true;
    const executor::FrameDrawing then = drawing(prepared, options);
    draw(prepared, then);
    const executor::FloatPicture thenMaps = executor_->shadowDepth();
    return proof::crawl({&then, &thenMaps}, executor_->surfaces(), {&now, &maps});
}

Renderer::Prepared Renderer::finest(const Prepared& prepared) {
    plan::Quality quality = prepared.plan.quality;
    quality.shadows = plan::ShadowMode::Rays;
    quality.errorPixels = 0;
    quality.maxTriangles.reset();
    return prepare(prepared.plan.view, quality, Waiting::UntilComplete);
}

} // namespace gnomon::frame
