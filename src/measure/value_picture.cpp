#include "measure/value_picture.h"

#include "executor/overlay/legend.h"
#include "hierarchy/world_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::measure {

namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr float kInShadow = 0.7F; // the light that is left there

executor::ValueScale scaleOf(const settings::ValueColors& colors, const Box& bounds, const glm::dvec3& up) {
    std::array<double, 2> range = {0, 90};
    if (colors.by == settings::ColorBy::Height) range = heightRange(bounds, up);
    if (colors.range) range = *colors.range;
    if (!(range[0] < range[1])) range[1] = range[0] + 1; // all is level
    return {colors.map, range[0], range[1]};
}

executor::Rgb inLight(const glm::vec3& color, float lit) {
    const auto level = [&](float channel) {
        return static_cast<std::uint8_t>(std::lround(255 * channel * (kInShadow + (1 - kInShadow) * lit)));
    };
    return {level(color.r), level(color.g), level(color.b)};
}

} // namespace

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
    return kDegrees * std::atan2(glm::length(normal - along * axis), std::abs(along));
}

void colorByValues(
    const settings::ValueColors& colors,
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    executor::Picture& picture) {
    const hierarchy::ModelSummary& model = renderer.model().summary();
    const glm::dvec3 up = frame.plan.view.up;
    const executor::ValueScale scale = scaleOf(colors, model.bounds, up);
    const glm::dvec3 origin = model.grid.world(frame.space.originCell);
    const executor::Raster<executor::SurfaceSample> surfaces = renderer.executor().surfaces();
    const bool hasShadows = frame.plan.quality.shadows != plan::ShadowMode::Off;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const executor::SurfaceSample& surface = surfaces.pixels[i];
        if (!(surface.isSurface > 0)) continue;
        const double value =
            valueOf(colors.by, origin + glm::dvec3(surface.position), glm::normalize(glm::dvec3(surface.normal)), up);
        const float lit = !hasShadows ? 1 : surface.isLitSide() ? surface.litFraction() : 0;
        picture.pixels[i] = inLight(scale.color(value), lit);
    }
    executor::Legend legend;
    const std::string unit(hierarchy::rowOf(model.unit).name);
    legend.title = {colors.by == settings::ColorBy::Height ? "height in " + unit : "slope in degrees"};
    legend.title.front() += hasShadows ? ", darker in the shadow" : "";
    legend.scale = executor::colorScale(scale);
    executor::drawLegend(picture, legend);
}

} // namespace gnomon::measure
