#include "viewer/panel/texel_plot.h"

#include "core/angle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon::viewer {

namespace {

constexpr double kQuarter = kPi / 2;
constexpr double kSame = 1e-3; // radians, and ratio of depths; smaller differences are invisible in the plot

bool isSame(const TexelPlotInput& a, const TexelPlotInput& b) {
    const auto near = [](const glm::dvec3& u, const glm::dvec3& v) { return glm::length(u - v) < kSame; };
    const auto alike = [](double u, double v) { return std::abs(u - v) <= kSame * std::abs(v); };
    const shadow::Scheme& s = a.scheme;
    const shadow::Scheme& t = b.scheme;
    return near(a.basis.view, b.basis.view) && near(a.basis.up, b.basis.up) && near(a.disc.heading, b.disc.heading) &&
           a.disc.fromBelow == b.disc.fromBelow && alike(a.frustum.near, b.frustum.near) &&
           alike(a.frustum.far, b.frustum.far) && alike(a.frustum.halfFovYRadians, b.frustum.halfFovYRadians) &&
           alike(a.frustum.aspect, b.frustum.aspect) && s.warp.rule == t.warp.rule && s.warp.eta == t.warp.eta &&
           s.warp.tsmFocus == t.warp.tsmFocus && s.slices == t.slices && s.splitLambda == t.splitLambda &&
           s.faces == t.faces;
}

} // namespace

glm::dvec3 LightDisc::direction(const glm::dvec2& point) const {
    const glm::dvec3 right = glm::cross(heading, up);
    const glm::dvec3 pole = fromBelow ? -up : up;
    const double radius = glm::length(point);
    if (!(radius > 0)) return pole;
    const double angle = std::min(radius, 1.0) * kQuarter;
    return pole * std::cos(angle) + (right * point.x + heading * point.y) * (std::sin(angle) / radius);
}

glm::dvec2 LightDisc::point(const glm::dvec3& towardsLight) const {
    const glm::dvec3 light = glm::normalize(towardsLight);
    const glm::dvec3 right = glm::cross(heading, up);
    const glm::dvec2 across(glm::dot(light, right), glm::dot(light, heading));
    const double length = glm::length(across);
    const double angle = std::atan2(length, glm::dot(light, fromBelow ? -up : up));
    return length > 0 ? across * (angle / kQuarter / length) : glm::dvec2(0);
}

LightDisc lightDisc(const Camera& camera, bool fromBelow) {
    LightDisc disc;
    disc.up = glm::normalize(camera.up);
    const CameraBasis basis = cameraBasis(camera);
    disc.heading = glm::normalize(glm::cross(disc.up, basis.right));
    disc.fromBelow = fromBelow;
    return disc;
}

double storageFactor(const TexelPlotInput& input, const glm::dvec3& towardsLight) {
    const glm::dvec3 inCamera = glm::normalize(toCamera(input.basis, towardsLight));
    return shadow::storageFactor(shadow::schemeMaps(input.frustum, inCamera, input.scheme));
}

void TexelPlot::ask(const std::optional<TexelPlotInput>& input) {
    if (input_ && input && isSame(*input_, *input)) return;
    input_ = input;
    next_ = 0;
}

void TexelPlot::improve(int count) {
    if (!input_) return;
    // The cells are computed with a stride that is coprime to their number, so that the first results cover the whole
    // disc.
    const std::size_t cells = values_.size();
    std::size_t stride = cells * 5 / 8 + 1;
    while (std::gcd(stride, cells) != 1)
        ++stride;
    for (int found = 0; found < count && next_ < cells; ++next_) {
        const std::size_t cell = next_ * stride % cells;
        const auto column = static_cast<int>(cell % static_cast<std::size_t>(side_));
        const auto row = static_cast<int>(cell / static_cast<std::size_t>(side_));
        const glm::dvec2 at = middle(column, row);
        if (glm::length(at) > 1) continue;
        values_[cell] = storageFactor(*input_, input_->disc.direction(at));
        ++found;
    }
}

glm::dvec2 TexelPlot::middle(int column, int row) const {
    return {(2 * column + 1.0) / side_ - 1, (2 * row + 1.0) / side_ - 1};
}

std::optional<TexelPlot::Range> TexelPlot::range() const {
    std::optional<Range> range;
    for (const std::optional<double>& value : values_) {
        if (!value) continue;
        if (!range) range = Range{*value, *value};
        range->min = std::min(range->min, *value);
        range->max = std::max(range->max, *value);
    }
    return range;
}

} // namespace gnomon::viewer
