#include "frame/frame_cuts.h"

#include "core/error.h"
#include "frame/ray_casters.h"
#include "frame/scene_facts.h"
#include "lod/caster_detail.h"
#include "lod/frame_cut.h"
#include "lod/nearest_depth.h"

#include <algorithm>
#include <cmath>

namespace gnomon::frame {

namespace {

void cut(PreparedFrame& frame, const plan::Quality& quality, const Residency& residency) {
    if (quality.maxTriangles)
        frame.errorPixels = lod::cappedErrorPixels(cutQuery(residency, frame), *quality.maxTriangles);
    frame.cut = lod::cutFrame(cutQuery(residency, frame));
}

/// Returns the view pyramid of the image, extended by `margin` pixels on each side.
ConvexVolume imageVolume(lod::DetailView detail, const CutView& cutView) {
    detail.tanHalfX *= 1 + 2 * cutView.margin / cutView.view.width;
    detail.tanHalfY *= 1 + 2 * cutView.margin / cutView.view.height;
    return lod::viewPyramid(detail);
}

/// Returns the section planes of a view in local space. `origin` is the origin of local space, in world space.
std::vector<Plane> localSections(const plan::View& view, const glm::dvec3& origin) {
    std::vector<Plane> planes;
    for (const Plane& plane : view.sections)
        planes.push_back({plane.normal, plane.signedDistance(origin)});
    return planes;
}

/// Removes the part of `volume` outside the section planes of `view`. `volume` is in local space, whose origin is
/// `origin` in world space.
void clipBySections(const plan::View& view, const glm::dvec3& origin, ConvexVolume& volume) {
    for (const Plane& plane : localSections(view, origin))
        volume.planes.push_back(plane);
}

} // namespace

void addSections(PreparedFrame& frame, const glm::dvec3& origin) {
    const plan::View& seen = frame.plan.view;
    for (std::size_t i = 1; i < frame.volumes.size() && seen.cutsCasters; ++i)
        clipBySections(seen, origin, frame.volumes[i]);
    const double slack = 4 * frame.space.step;
    for (const Plane& plane : localSections(seen, origin))
        frame.volumes.push_back({{{plane.normal, plane.offset + slack}, {-plane.normal, slack - plane.offset}}});
    frame.sectionVolumes = seen.sections.size();
    if (frame.volumes.size() > lod::kMaxVolumes)
        throw Error(
            "sections",
            "too many sections and shadow maps together",
            "at most " + std::to_string(lod::kMaxVolumes - 1) + " maps and planes",
            std::to_string(frame.volumes.size() - 1));
}

void clipToModel(const Box& model, const glm::dvec3& origin, ConvexVolume& receivers) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 inward(0);
        inward[axis] = 1;
        receivers.planes.push_back({inward, origin[axis] - model.min[axis]});
        receivers.planes.push_back({-inward, model.max[axis] - origin[axis]});
    }
}

lod::CutQuery cutQuery(const Residency& residency, const PreparedFrame& frame) {
    lod::CutQuery query = residency.query();
    query.rule = frame.rule.get();
    query.errorPixels = frame.errorPixels;
    query.volumes = frame.volumes;
    query.sectionVolumes = frame.sectionVolumes;
    return query;
}

void cutImage(
    PreparedFrame& frame,
    const CutView& cutView,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range,
    const Residency& residency,
    const hierarchy::Grid& grid) {
    const plan::View& view = cutView.view;
    lod::DetailView detail = detailView(view, view.camera.eye - grid.origin);
    const double nearest = lod::nearestDepth(*residency.query().trees, detail);
    if (std::isfinite(nearest)) detail.nearestDepth = std::max(detail.nearestDepth, nearest);
    frame.rule = std::make_shared<lod::ErrorRule>(detail);
    frame.volumes = {imageVolume(detail, cutView)};
    clipBySections(view, grid.origin, frame.volumes.front());
    if (range) {
        frame.volumes.push_back(lod::localVolume(plan::sweptView(view, *range), detail));
        if (view.cutsCasters) clipBySections(view, grid.origin, frame.volumes.back());
    }
    cut(frame, quality, residency);
}

void cutPartitions(PreparedFrame& frame, const Residency& residency) {
    frame.volumes.resize(1);
    const plan::View& seen = frame.plan.view;
    if (frame.plan.passes.empty() && !frame.hasOneCasterList() && seen.sections.empty()) {
        frame.cut.lists.casters.clear();
        return;
    }
    const lod::DetailView view = frame.rule->view();
    std::vector<lod::CasterDetail> casters;
    for (const plan::ShadowPass& pass : frame.plan.passes) {
        if (!seen.pointLight) casters.push_back(lod::casterDetail(view, pass.map));
        // Without caster culling, every shadow map draws the whole model at the level of detail that the map requires.
        const bool isCulled = frame.plan.quality.cullCasters != plan::CasterCulling::Off;
        frame.volumes.push_back(isCulled ? lod::localVolume(pass.map.casterVolume, view) : ConvexVolume{});
    }
    if (seen.pointLight) {
        casters = pointCasterDetails(frame);
        if (frame.hasOneCasterList()) frame.volumes.push_back(rayCasterVolume(frame));
    } else if (frame.hasOneCasterList()) {
        casters.push_back(rayCasterDetail(frame));
        frame.volumes.push_back(casters.back().casters);
    }
    const glm::dvec3 origin = seen.camera.eye - view.eye;
    for (lod::CasterDetail& caster : casters)
        clipToModel(frame.facts.bounds, origin, caster.receivers);
    addSections(frame, origin);
    frame.rule = std::make_shared<lod::ErrorRule>(view, std::move(casters));
    cut(frame, frame.plan.quality, residency);
}

} // namespace gnomon::frame
