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

} // namespace

bool isSameMap(const FramePlan& now, const FramePlan& before, std::size_t pass) {
    if (!isSameTexture(now, before) || now.light != before.light) return false;
    const ShadowPass& a = now.passes[pass];
    const ShadowPass& b = before.passes[pass];
    return a.map.stable && a.map.stable == b.map.stable && a.map.gutter == b.map.gutter &&
           a.clampsDepth == b.clampsDepth;
}

} // namespace gnomon::plan
