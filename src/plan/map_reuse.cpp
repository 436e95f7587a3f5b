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
               [](const ShadowPass& pass, const ShadowPass& other) { return pass.rectangle == other.rectangle; });
}

} // namespace

bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass) {
    if (!isSameTexture(now, before) || now.view.towardsLight != before.view.towardsLight) return false;
    const ShadowPass& a = now.passes[pass];
    const ShadowPass& b = before.passes[pass];
    return a.stable && a.stable == b.stable && a.texelFromMap == b.texelFromMap && a.clampsDepth == b.clampsDepth;
}

} // namespace gnomon::plan
