#include "frame/accumulation.h"

#include "core/check.h"
#include "plan/light_directions.h"

#include <algorithm>
#include <cmath>

namespace gnomon::frame {

namespace {

/// Converts a coordinate of a sample, in units of 2^-32 of a pixel, to a number in [-1/2, 1/2). Adding a whole pixel
/// does not change the result.
double aroundMiddle(std::uint32_t place) {
    return std::ldexp(static_cast<double>(static_cast<std::int32_t>(place)), -32);
}

} // namespace

glm::dvec2 subpixelOffset(int sample) {
    // The direction numbers of the two Sobol dimensions. The first dimension is the van der Corput sequence, and the
    // second has the primitive polynomial x + 1.
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t directionX = std::uint32_t{1} << 31U;
    std::uint32_t directionY = directionX;
    for (auto bits = static_cast<std::uint32_t>(sample); bits != 0; bits >>= 1U) {
        if ((bits & 1U) != 0) {
            x ^= directionX;
            y ^= directionY;
        }
        directionX >>= 1U;
        directionY ^= directionY >> 1U;
    }
    return {aroundMiddle(x), aroundMiddle(y)};
}

glm::dvec2 mapShift(int sample) {
    // The factors are the inverse of the plastic number, and its square (Roberts 2018).
    const glm::dvec2 place = static_cast<double>(sample) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
    return place - glm::floor(place + 0.5);
}

void Accumulation::begin(Renderer& renderer, const Frame& frame, int samples) {
    renderer_ = &renderer;
    frame_ = &frame;
    wanted_ = std::max(samples, plan::lightFrames(plan()));
    const bool hasSky = plan().sky.directions > 0; // light from the sky changes all image tiles
    whole_ = hasSky ? wanted_ : std::max(samples, plan::minFirstPoints(wanted_));
    const render::DrawInputs drawing = renderer.drawing(frame, frame.options);
    shown_ = render::toneMappingOf(drawing);
    sum_.reset(shown_.hasGround, render::rowsOf(drawing).first);
    if (hasSky) {
        onGround_ = render::groundShares(drawing);
        onGround_.sky /= static_cast<float>(plan::levelSkyLight(wanted_, plan().sky.model));
        FrameOptions options = frame.options;
        leaveSkyOut(options);
        renderer.drawSample(frame, options);
    }
    take(0);
}

void Accumulation::add() {
    GNOMON_CHECK_OP(samples(), <, wanted_);
    drawSunlit(samples());
    take(samples());
}

void Accumulation::leaveSkyOut(FrameOptions& options) const {
    options.lightPart = render::LightPart::WithoutSky;
    options.groundShade = onGround_.sun;
}

/// Returns the image tiles in which frame `sample` of the mean is drawn. Null means all tiles.
const std::shared_ptr<const shadow::TileMask>& Accumulation::tilesOf(int sample) const {
    return sample < whole_ ? frame_->options.tiles : plan().penumbra.tiles;
}

void Accumulation::drawSunlit(int sample) {
    FrameOptions options = frame_->options;
    options.subpixel = subpixelOffset(sample);
    options.mapShift = mapShift(sample);
    options.tiles = tilesOf(sample);
    const bool hasSky = plan().sky.directions > 0;
    if (hasSky) leaveSkyOut(options);
    const plan::View& view = plan().view;
    if (plan().penumbra.directions > 1) {
        const glm::dvec2 point = plan::discPoint(sample, wanted_);
        renderer_->drawTowards(*frame_, plan::towardsDisc(view.towardsLight, view.sunAngleRadians, point), options);
    } else if (hasSky) { // the previous frame's image of the sky has replaced the prepared frame
        renderer_->drawTowards(*frame_, view.towardsLight, options);
    } else {
        renderer_->drawSample(*frame_, options);
    }
}

/// Adds the last drawn image, which is frame `sample`, to the sum of all frames. With sky light, also draws the image
/// with the light of sky sample `sample`, and adds both images.
void Accumulation::take(int sample) {
    render::Backend& backend = renderer_->backend();
    if (plan().sky.directions == 0) return sum_.add(backend.light(), tilesOf(sample).get());
    render::LightPicture light = backend.light();
    const plan::SkyPart part = plan::skyPart(sample, wanted_, plan().sky.model, plan().view.up);
    FrameOptions options = frame_->options;
    options.subpixel = subpixelOffset(sample);
    options.mapShift = mapShift(sample);
    options.lightPart = render::LightPart::SkyDirection;
    options.skyWeight = part.weight;
    const double level = part.weight * glm::dot(part.direction, glm::normalize(plan().view.up));
    options.groundShade = static_cast<float>(level) * onGround_.sky;
    renderer_->drawTowards(*frame_, part.direction, options);
    render::addLight(light, backend.light());
    sum_.add(light);
}

} // namespace gnomon::frame
