#include "sun/sun_view.h"

#include "exact/plain_shadows.h"
#include "frame/frame_cuts.h"
#include "frame/ray_casters.h"
#include "frame/scene_facts.h"
#include "lod/frame_cut.h"
#include "plan/cell_maps.h"
#include "plan/distant_view.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::sun {

namespace {

/// Returns a convex volume that contains the volume `receivers` and all rays from there towards each of `lights`.
/// Shadow casters outside it have no effect.
ConvexVolume sweptTowards(const ConvexVolume& receivers, std::span<const IntegerLight> lights) {
    ConvexVolume swept;
    for (const Plane& plane : receivers.planes) {
        // A plane of the volume remains if each light is on its inner side, because rays from inside then stay on the
        // inner side.
        const bool isKept = std::all_of(lights.begin(), lights.end(), [&](const IntegerLight& light) {
            return glm::dot(plane.normal, light.unit()) >= 0;
        });
        if (isKept) swept.planes.push_back(plane);
    }
    return swept;
}

glm::uvec3 cellOf(const hierarchy::GridPoint& p) {
    return {p.x, p.y, p.z};
}

} // namespace

SunView::SunView(
    frame::Renderer& renderer,
    const plan::View& view,
    const plan::Quality& quality,
    std::span<const IntegerLight> lights)
    : view_(plan::distantView(view, renderer.model().summary().bounds)),
      quality_(quality),
      picture_(view.width, view.height) {
    quality_.shadows = plan::ShadowMode::Exact;
    prepare(renderer, lights);
    drawing_ = renderer.drawing(frame_, {});
    drawing_.exactCasters = &frame_.cut.lists.casters[0];
    raster::Rasterizer rasterizer;
    std::vector<std::uint64_t> words(picture_.pixels.size());
    render::drawPoints(drawing_, {&rasterizer, &pass_, &words, &picture_}, points_);
    render::gatherExactCasters(drawing_, pass_, casters_);
}

plan::FramePlan SunView::planFor(const IntegerLight& light) const {
    plan::View view = view_;
    view.towardsLight = glm::dvec3(light.direction);
    return plan::planFrame(view, quality_, frame_.facts).plan;
}

/// Selects the clusters that are drawn in the image or cast shadows on it, with one level of detail for both. `frame_`
/// must already contain the error rule of the image, the measured facts about the scene, and a plan.
void SunView::cutCasters(const frame::Residency& residency, std::span<const IntegerLight> lights) {
    if (!frame_.facts.visible->anything) {
        frame_.plan = planFor(lights.front());
        frame_.cut.lists.casters.resize(1);
        frame_.cut.lists.sections.resize(view_.sections.size());
        return;
    }
    std::vector<lod::CasterDetail> details;
    const std::size_t stride = (lights.size() + kDetailLights - 1) / kDetailLights;
    for (std::size_t i = 0; i < lights.size(); i += stride) {
        frame_.plan = planFor(lights[i]);
        details.push_back(frame::rayCasterDetail(frame_));
    }
    frame_.volumes.resize(1);
    frame_.volumes.push_back(sweptTowards(details.front().receivers, lights));
    const lod::DetailView detail = frame_.rule->view();
    frame::addSections(frame_, view_.camera.eye - detail.eye);
    for (lod::CasterDetail& caster : details)
        frame::clipToModel(frame_.facts.bounds, view_.camera.eye - detail.eye, caster.receivers);
    frame_.rule = std::make_shared<lod::ErrorRule>(detail, std::move(details));
    frame_.cut = lod::cutFrame(frame::cutQuery(residency, frame_));
}

void SunView::prepare(frame::Renderer& renderer, std::span<const IntegerLight> lights) {
    constexpr auto kWaiting = frame::Waiting::UntilComplete;
    const hierarchy::ModelSummary& model = renderer.model().summary();
    frame::Residency& residency = renderer.residency();
    residency.admitLoaded(kWaiting);
    view_.towardsLight = glm::dvec3(lights.front().direction);
    std::vector<lod::DepthCandidate> scratch;
    do {
        frame_ = {};
        frame_.space = render::cameraRelativeSpace(view_, model.grid, model.bounds);
        frame_.errorPixels = quality_.errorPixels;
        frame::cutImage(frame_, {view_, 0}, quality_, std::nullopt, residency, model.grid);
        frame_.facts = frame::sceneFacts(
            view_, model.bounds, frame::cutQuery(residency, frame_), frame_.cut, std::nullopt, scratch);
        cutCasters(residency, lights);
        frame_.residency = residency.serve(frame::cutQuery(residency, frame_), frame_.cut, kWaiting);
    } while (frame_.residency.hasChanged);
}

render::DrawInputs SunView::collect(const plan::FramePlan& plan) {
    render::DrawInputs drawing = drawing_;
    drawing.plan = &plan;
    const exact::SampleSpace space = render::sampleSpace(drawing);
    exact_.samples().reset(space, points_.size());
    points_.addTo(exact_.samples(), render::tolerance(space.light));
    return drawing;
}

exact::ExactStatistics SunView::resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) {
    std::fill(isLit.begin(), isLit.end(), std::uint8_t{0});
    const plan::FramePlan plan = planFor(light);
    if (plan.sampleGridMaps.empty()) return {}; // no surface is visible
    const render::DrawInputs drawing = collect(plan);
    const exact::SampleList& samples = exact_.samples();
    const std::vector<glm::dmat3> planes = render::cellPlanes(drawing, samples.space().shear);
    const exact::ExactStatistics statistics =
        exact_.resolve({casters_, cellOf(frame_.space.originCell), planes, plan::cellSide(plan)});
    constexpr std::size_t kGrain = 16384;
    const std::span<const std::uint8_t> statuses = exact_.statuses();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            isLit[samples.pixel[i]] = exact::isDark(statuses[i]) ? 0 : 1;
    });
    return statistics;
}

void SunView::resolvePlainly(
    const IntegerLight& light, std::span<const std::uint8_t> isRequested, std::span<std::uint8_t> isLit) {
    std::fill(isLit.begin(), isLit.end(), std::uint8_t{0});
    const plan::FramePlan plan = planFor(light);
    if (plan.sampleGridMaps.empty()) return;
    collect(plan);
    const exact::SampleList& samples = exact_.samples();
    const std::vector<std::uint8_t> isMeant = [&] {
        std::vector<std::uint8_t> result(samples.size());
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = isRequested[samples.pixel[i]];
        return result;
    }();
    const std::vector<std::uint8_t> statuses =
        exact::plainStatuses(samples, casters_, cellOf(frame_.space.originCell), isMeant);
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (isMeant[i] != 0) isLit[samples.pixel[i]] = exact::isDark(statuses[i]) ? 0 : 1;
}

glm::dvec3 SunView::position(std::size_t i) const {
    return drawing_.grid.world(frame_.space.originCell) + points_.position(i) * frame_.space.step;
}

} // namespace gnomon::sun
