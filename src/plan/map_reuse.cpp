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
    return a.view.cutsCasters == b.view.cutsCasters && a.view.sections == b.view.sections;
}

bool isSameCamera(const FramePlan& a, const FramePlan& b) {
    return a.view.camera.eye == b.view.camera.eye && a.basis.right == b.basis.right && a.basis.up == b.basis.up &&
           a.basis.view == b.basis.view;
}

/// Returns true if the texels of the shadow maps `a` and `b` cover the same points of the world. Stabilised maps are
/// compared by their place in the world, and may have different cameras. All other maps need the same camera.
bool isSamePlace(
    const FramePlan& now, const FramePlan& before, const shadow::ShadowMap& a, const shadow::ShadowMap& b) {
    if (a.shift != b.shift) return false;
    if (a.stable || b.stable) return a.stable == b.stable;
    return isSameCamera(now, before) && a.origin == b.origin && a.lightClipFromCamera() == b.lightClipFromCamera();
}

} // namespace

bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass) {
    if (!isSameTexture(now, before) || now.light != before.light || !hasSameSections(now, before)) return false;
    const ShadowPass& a = now.passes[pass];
    const ShadowPass& b = before.passes[pass];
    return isSamePlace(now, before, a.map, b.map) && a.map.gutter == b.map.gutter && a.clampsDepth == b.clampsDepth;
}

bool isSameImage(const FramePlan& now, const FramePlan& before) {
    if (now.view != before.view || now.quality != before.quality || now.backend != before.backend ||
        now.selector != before.selector || now.passOfPartition != before.passOfPartition ||
        now.passes.size() != before.passes.size())
        return false;
    for (std::size_t pass = 0; pass < now.passes.size(); ++pass)
        if (!isSameMap(now, before, pass) || now.passes[pass].map.filterTexels != before.passes[pass].map.filterTexels)
            return false;
    return true;
}

} // namespace gnomon::plan
