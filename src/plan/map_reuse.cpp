#include "plan/map_reuse.h"

#include <algorithm>

namespace gnomon::plan {

namespace {

bool isSameTexture(const FramePlan& a, const FramePlan& b) {
    return a.textureWidth == b.textureWidth && a.textureHeight == b.textureHeight &&
           std::equal(
               a.passes.begin(),
               a.passes.end(),
               b.passes.begin(),
               b.passes.end(),
               [](const ShadowPass& pass, const ShadowPass& other) {
                   return pass.map.rectangle == other.map.rectangle;
               });
}

bool hasSameSections(const FramePlan& a, const FramePlan& b) {
    const auto isSame = [](const Plane& p, const Plane& q) { return p.normal == q.normal && p.offset == q.offset; };
    const std::vector<Plane>& planes = a.view.sections;
    const std::vector<Plane>& others = b.view.sections;
    return a.view.cutsCasters == b.view.cutsCasters &&
           std::equal(planes.begin(), planes.end(), others.begin(), others.end(), isSame);
}

bool isSameCamera(const FramePlan& a, const FramePlan& b) {
    return a.view.camera.eye == b.view.camera.eye && a.basis.right == b.basis.right && a.basis.up == b.basis.up &&
           a.basis.view == b.basis.view;
}

/// Whether two maps cover the same of the world, texel by texel: stabilised ones wherever the camera is, others seen
/// from the same place alone.
bool isSamePlace(
    const FramePlan& now, const FramePlan& before, const shadow::ShadowMap& a, const shadow::ShadowMap& b) {
    if (a.stable || b.stable) return a.stable == b.stable;
    const bool hasSameGrid = a.warped.fitted == b.warped.fitted ||
                             (a.warped.fitted && b.warped.fitted && *a.warped.fitted == *b.warped.fitted);
    return isSameCamera(now, before) && hasSameGrid && a.origin == b.origin &&
           a.lightClipFromCamera() == b.lightClipFromCamera();
}

} // namespace

bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass) {
    if (!isSameTexture(now, before) || now.light != before.light || !hasSameSections(now, before)) return false;
    const ShadowPass& a = now.passes[pass];
    const ShadowPass& b = before.passes[pass];
    return isSamePlace(now, before, a.map, b.map) && a.map.gutter == b.map.gutter && a.clampsDepth == b.clampsDepth;
}

bool isSameQuestion(const FramePlan& now, const FramePlan& before) {
    if (now.passes.size() != before.passes.size() || !isSameCamera(now, before)) return false;
    for (std::size_t pass = 0; pass < now.passes.size(); ++pass)
        if (!isSameMap(now, before, pass) || now.passes[pass].map.filterTexels != before.passes[pass].map.filterTexels)
            return false;
    const View& a = now.view;
    const View& b = before.view;
    return a.width == b.width && a.height == b.height && a.camera.fovYRadians == b.camera.fovYRadians &&
           now.quality.filter == before.quality.filter && now.splits == before.splits &&
           now.passOfPartition == before.passOfPartition;
}

} // namespace gnomon::plan
