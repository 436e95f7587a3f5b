#include "inspect/value_picture.h"

#include "core/angle.h"
#include "hierarchy/world_frame.h"
#include "inspect/seen_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::inspect {

namespace {

constexpr double kDecade = 10;
constexpr float kInShadow = 0.7F; // share of the colour that remains in shadow

/// Returns the range of values that the colours of a picture show if the user requests no range.
std::array<double, 2> usualRange(
    const settings::ValueColors& colors,
    const hierarchy::ModelSummary& model,
    const glm::dvec3& up,
    const ValuePicture& values) {
    if (colors.by == settings::ColorBy::Height) return heightRange(model.bounds, up);
    if (colors.by == settings::ColorBy::Slope) return {0, 90};
    for (const hierarchy::Field& field : model.fields)
        if (colors.by == settings::ColorBy::Field && field.name == colors.field) return {field.min, field.max};
    double largest = 0; // max of the visible errors
    for (const double value : values.pixels)
        if (value > largest) largest = value;
    return {largest / render::kScaleSpan, largest};
}

std::string titleOf(const settings::ValueColors& colors, std::string_view unit) {
    switch (colors.by) {
    case settings::ColorBy::Height:
        return "height in " + std::string(unit);
    case settings::ColorBy::Slope:
        return "slope in degrees";
    case settings::ColorBy::Error:
        return "stored error in " + std::string(unit);
    default:
        return colors.field; // a legend draws a space for a character without a glyph
    }
}

/// Returns an image with the height or slope of the visible surface at each pixel.
ValuePicture geometricValues(settings::ColorBy by, const frame::Renderer& renderer, const frame::Frame& frame) {
    const glm::dvec3 origin = renderer.model().summary().grid.world(frame.space.originCell);
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    ValuePicture values(surfaces.width, surfaces.height, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
        const render::SurfaceSample& surface = surfaces.pixels[i];
        if (!(surface.isSurface > 0)) continue;
        values.pixels[i] = valueOf(
            by, origin + glm::dvec3(surface.position), glm::normalize(glm::dvec3(surface.normal)), frame.plan.view.up);
    }
    return values;
}

ValuePicture valuesOf(const settings::ValueColors& colors, const frame::Renderer& renderer, const frame::Frame& frame) {
    if (colors.by == settings::ColorBy::Error) return seenErrors(renderer, frame);
    if (colors.by == settings::ColorBy::Field) return seenField(renderer, frame, colors.field);
    return geometricValues(colors.by, renderer, frame);
}

render::Rgb inLight(const glm::vec3& color, float lit) {
    const auto level = [&](float channel) {
        return static_cast<std::uint8_t>(std::lround(255 * channel * (kInShadow + (1 - kInShadow) * lit)));
    };
    return {level(color.r), level(color.g), level(color.b)};
}

} // namespace

render::ValueScale valueScale(const settings::ValueColors& colors, const std::array<double, 2>& usual) {
    std::array<double, 2> range = colors.range.value_or(usual);
    if (!(range[0] < range[1])) range[1] = range[0] + 1; // makes a range for a flat surface
    const bool isWide = colors.by == settings::ColorBy::Field && range[1] > kDecade * range[0];
    const bool isLogarithmic = range[0] > 0 && (colors.by == settings::ColorBy::Error || isWide);
    if (isLogarithmic && !colors.range) range[0] = std::max(range[0], range[1] / render::kScaleSpan);
    return {colors.map, range[0], range[1], isLogarithmic};
}

std::array<double, 2> heightRange(const Box& bounds, const glm::dvec3& up) {
    const glm::dvec3 axis = glm::normalize(up);
    std::array<double, 2> range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(
            (corner & 1) != 0 ? bounds.max.x : bounds.min.x,
            (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
            (corner & 4) != 0 ? bounds.max.z : bounds.min.z);
        range = {std::min(range[0], glm::dot(axis, p)), std::max(range[1], glm::dot(axis, p))};
    }
    return range;
}

double valueOf(settings::ColorBy by, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up) {
    const glm::dvec3 axis = glm::normalize(up);
    if (by == settings::ColorBy::Height) return glm::dot(axis, position);
    const double along = glm::dot(axis, normal);
    return degreesFromRadians(std::atan2(glm::length(normal - along * axis), std::abs(along)));
}

void colorByValues(
    const settings::ValueColors& colors,
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    render::Picture& picture) {
    const hierarchy::ModelSummary& model = renderer.model().summary();
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    const bool hasShadows = frame.plan.quality.shadows != plan::ShadowMode::Off;
    const auto paint = [&](std::size_t i, const glm::vec3& color) {
        const render::SurfaceSample& surface = surfaces.pixels[i];
        const float lit = !hasShadows ? 1 : surface.isLitSide() ? surface.litFraction() : 0;
        picture.pixels[i] = inLight(color, lit);
    };
    if (colors.by == settings::ColorBy::Vertex) {
        const render::Picture stored = seenColors(renderer, frame);
        for (std::size_t i = 0; i < stored.pixels.size(); ++i)
            if (surfaces.pixels[i].isSurface > 0)
                paint(i, glm::vec3(stored.pixels[i][0], stored.pixels[i][1], stored.pixels[i][2]) / 255.0F);
        return;
    }
    const ValuePicture values = valuesOf(colors, renderer, frame);
    const render::ValueScale scale = valueScale(colors, usualRange(colors, model, frame.plan.view.up, values));
    render::Legend legend;
    legend.title = {
        titleOf(colors, hierarchy::rowOf(model.unit).name) + (scale.isLogarithmic ? ", logarithmic" : "") +
        (hasShadows ? ", darker in the shadow" : "")};
    for (std::size_t i = 0; i < values.pixels.size(); ++i)
        if (!std::isnan(values.pixels[i])) paint(i, scale.color(values.pixels[i]));
    legend.scale = render::colorScale(scale);
    render::drawLegend(picture, legend);
}

} // namespace gnomon::inspect
