#include "viewer/view_settings.h"

#include <algorithm>

namespace gnomon::viewer {

namespace {

using plan::Choice;
using plan::ShadowMode;

ShadowMode modeOf(Scheme scheme) {
    if (scheme == Scheme::Off) return ShadowMode::Off;
    if (scheme == Scheme::Rays) return ShadowMode::Rays;
    if (scheme == Scheme::Auto) return ShadowMode::Auto;
    return scheme == Scheme::Exact ? ShadowMode::Exact : ShadowMode::Maps;
}

} // namespace

const char* name(Scheme scheme) {
    switch (scheme) {
    case Scheme::Off:
        return "no shadows";
    case Scheme::OneMap:
        return "one map";
    case Scheme::Slices:
        return "slices";
    case Scheme::Faces:
        return "faces";
    case Scheme::FacesAndSlices:
        return "faces and slices";
    case Scheme::Exact:
        return "exact";
    case Scheme::Rays:
        return "rays";
    case Scheme::Auto:
        return "auto: exact or maps";
    }
    return "";
}

Scheme schemeOf(const plan::Quality& quality) {
    if (quality.shadows == ShadowMode::Off) return Scheme::Off;
    if (quality.shadows == ShadowMode::Rays) return Scheme::Rays;
    if (quality.shadows == ShadowMode::Exact) return Scheme::Exact;
    if (quality.shadows == ShadowMode::Auto && !quality.mapsBecause) return Scheme::Auto;
    const bool hasSlices = quality.zPartitions.value_or(2) > 1;
    if (quality.facePartitions != Choice::Off) return hasSlices ? Scheme::FacesAndSlices : Scheme::Faces;
    return hasSlices ? Scheme::Slices : Scheme::OneMap;
}

void choose(Scheme scheme, plan::Quality& quality) {
    quality.shadows = modeOf(scheme);
    quality.mapsBecause.reset();
    if (quality.shadows != ShadowMode::Maps) return;
    const bool hasSlices = scheme == Scheme::Slices || scheme == Scheme::FacesAndSlices;
    const bool hasFaces = scheme == Scheme::Faces || scheme == Scheme::FacesAndSlices;
    if (!hasSlices)
        quality.zPartitions = 1;
    else if (quality.zPartitions == 1)
        quality.zPartitions = 4;
    if (!hasFaces)
        quality.facePartitions = Choice::Off;
    else if (quality.facePartitions == Choice::Off)
        quality.facePartitions = Choice::On;
}

void stepScheme(plan::Quality& quality, int step) {
    const auto count = static_cast<int>(kSchemes.size());
    const auto current = std::find(kSchemes.begin(), kSchemes.end(), schemeOf(quality)) - kSchemes.begin();
    const int next = ((static_cast<int>(current) + step) % count + count) % count;
    choose(kSchemes[static_cast<std::size_t>(next)], quality);
}

} // namespace gnomon::viewer
