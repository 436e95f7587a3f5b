#include "viewer/view_settings.h"

#include "inspect/value_picture.h"

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

namespace {

bool areBySame(const settings::ValueColors& a, const settings::ValueColors& b) {
    return a.by == b.by && a.field == b.field;
}

} // namespace

std::vector<settings::ValueColors> colorChoices(
    const hierarchy::ModelSummary& model, const plan::Capabilities& capabilities) {
    using settings::ColorBy;
    std::vector<settings::ValueColors> choices;
    for (const auto& each : settings::kColorBys) {
        if (each.value == ColorBy::Vertex && !model.hasColors) continue;
        if (settings::isOfTriangles(each.value) && !capabilities.seesTriangles) continue;
        choices.push_back({each.value});
    }
    if (capabilities.seesTriangles)
        for (const hierarchy::Field& field : model.fields)
            choices.push_back({ColorBy::Field, field.name});
    return choices;
}

std::array<double, 2> widestEnds(
    const settings::ValueColors& colors, const hierarchy::ModelSummary& model, const glm::dvec3& up) {
    if (colors.by == settings::ColorBy::Height) return inspect::heightRange(model.bounds, up);
    if (colors.by == settings::ColorBy::Error && !model.levels.empty())
        return {
            model.levels.front().maxError, std::max(model.levels.back().maxError, 2 * model.levels.front().maxError)};
    for (const hierarchy::Field& field : model.fields)
        if (colors.by == settings::ColorBy::Field && field.name == colors.field) return {field.min, field.max};
    return {0, 90};
}

bool isAmong(std::span<const settings::ValueColors> choices, const settings::ValueColors& colors) {
    return std::any_of(choices.begin(), choices.end(), [&](const auto& choice) { return areBySame(choice, colors); });
}

std::string stepColors(std::span<const settings::ValueColors> choices, int step, settings::ValueColors& colors) {
    std::size_t at = 0; // 0, no colours, if no choice is the current one
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (areBySame(choices[i], colors)) at = i;
    const auto count = static_cast<std::ptrdiff_t>(choices.size());
    const plan::ColorMap map = colors.map;
    colors = choices[static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(at) + step) % count + count) % count)];
    colors.map = map;
    return "colours: " + nameOf(colors);
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
