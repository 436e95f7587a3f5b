#include "viewer/view_settings.h"

#include "settings/view_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::viewer {

namespace {

using plan::Choice;
using plan::ShadowMode;

constexpr std::array kOverlays = {
    OverlayName{executor::Overlay::None, "none"},
    OverlayName{executor::Overlay::Partitions, "partitions"},
    OverlayName{executor::Overlay::Texels, "texels"},
    OverlayName{executor::Overlay::Aliasing, "aliasing"},
    OverlayName{executor::Overlay::Lod, "level of detail"},
    OverlayName{executor::Overlay::Clusters, "clusters"},
    OverlayName{executor::Overlay::Residency, "residency"},
};

constexpr std::array kWarps = {
    shadow::WarpRule::Auto,
    shadow::WarpRule::None,
    shadow::WarpRule::Lspsm,
    shadow::WarpRule::Psm,
    shadow::WarpRule::Tsm,
    shadow::WarpRule::Minimax};

/// The entry of `all` that lies `step` behind `current`, around; the first if it is not among them.
template <class Range, class Value>
Value stepped(const Range& all, const Value& current, int step) {
    const auto found = std::find(std::begin(all), std::end(all), current);
    if (found == std::end(all)) return *std::begin(all);
    const auto count = static_cast<int>(std::size(all));
    const auto at = static_cast<int>(found - std::begin(all));
    return std::begin(all)[((at + step) % count + count) % count];
}

std::string onOff(const char* what, bool isOn) {
    return std::string(what) + (isOn ? ": on" : ": off");
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
    case Scheme::Rays:
        return "rays";
    }
    return "";
}

std::span<const OverlayName> overlayNames() {
    return kOverlays;
}

const char* name(executor::Overlay overlay) {
    for (const OverlayName& entry : kOverlays)
        if (entry.overlay == overlay) return entry.name;
    return "";
}

std::span<const shadow::WarpRule> warpRules() {
    return kWarps;
}

Scheme schemeOf(const plan::Quality& quality) {
    if (quality.shadows == ShadowMode::Off) return Scheme::Off;
    if (quality.shadows == ShadowMode::Rays) return Scheme::Rays;
    const bool hasSlices = quality.zPartitions.value_or(2) > 1;
    if (quality.facePartitions != Choice::Off) return hasSlices ? Scheme::FacesAndSlices : Scheme::Faces;
    return hasSlices ? Scheme::Slices : Scheme::OneMap;
}

void choose(Scheme scheme, plan::Quality& quality) {
    const bool hasMaps = scheme != Scheme::Off && scheme != Scheme::Rays;
    quality.shadows = hasMaps ? ShadowMode::Maps : scheme == Scheme::Off ? ShadowMode::Off : ShadowMode::Rays;
    if (!hasMaps) return;
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

std::string stepScheme(plan::Quality& quality, int step) {
    const Scheme scheme = stepped(kSchemes, schemeOf(quality), step);
    choose(scheme, quality);
    return std::string("scheme: ") + name(scheme);
}

std::string stepWarp(plan::Quality& quality, int step) {
    quality.warp.rule = stepped(kWarps, quality.warp.rule, step);
    return "warp: " + plan::warpName(quality.warp);
}

std::string stepSlices(plan::Quality& quality, int step) {
    if (step == 0) {
        if (quality.zPartitions)
            quality.zPartitions.reset();
        else
            quality.zPartitions = 4;
    } else {
        quality.zPartitions = std::clamp(quality.zPartitions.value_or(4) + step, 1, settings::kMaxSlices);
    }
    return "slices: " + (quality.zPartitions ? std::to_string(*quality.zPartitions) : std::string("auto"));
}

std::string stepFaces(plan::Quality& quality) {
    constexpr std::array kChoices = {Choice::Off, Choice::On, Choice::Auto};
    constexpr std::array kWords = {"off", "on", "auto"};
    quality.facePartitions = stepped(kChoices, quality.facePartitions, 1);
    return std::string("faces: ") + kWords[static_cast<std::size_t>(quality.facePartitions)];
}

std::string stepTexels(plan::Quality& quality, int step) {
    // The count doubles by doubling the shorter side, so that sides stay powers of two if they were.
    int& width = quality.shadowTexelsWidth;
    int& height = quality.shadowTexelsHeight;
    if (step > 0) {
        int& side = width <= height ? width : height;
        side = std::min(side * 2, kMostShadowTexels);
    } else {
        int& side = width <= height ? height : width;
        side = std::max(side / 2, kLeastShadowTexels);
    }
    return "shadow texels: " + std::to_string(width) + " x " + std::to_string(height);
}

std::string stepFilter(plan::Quality& quality) {
    constexpr std::array kWidths = {0, 2, 3, 5};
    quality.filter = stepped(kWidths, quality.filter, 1);
    return quality.filter == 0 ? "filter: none"
                               : "filter: " + std::to_string(quality.filter) + " x " + std::to_string(quality.filter);
}

std::string stepDetail(plan::Quality& quality, int step) {
    quality.errorPixels = std::clamp(quality.errorPixels * std::exp2(0.5 * step), kLeastErrorPixels, kMostErrorPixels);
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "detail: %.3g px of error", quality.errorPixels);
    return text.data();
}

std::string toggleCulling(plan::Quality& quality) {
    quality.cullCasters = !quality.cullCasters;
    return onOff("caster culling", quality.cullCasters);
}

std::string toggleStabilising(plan::Quality& quality) {
    quality.stabilize = !quality.stabilize;
    return onOff("stabilised slices", quality.stabilize);
}

} // namespace gnomon::viewer
