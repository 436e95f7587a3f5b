// The background of an image. It has one colour per row.
#pragma once

#include "render/backend.h"

#include <optional>
#include <vector>

namespace gnomon::render {

/// Returns the background colour of each row of the image, from top to bottom. The sky colour of a row is the colour in
/// the direction through the middle of the row. A transparent background is black.
std::vector<Rgb> backgroundRows(const DrawInputs& frame);

/// Parameters of the sky colour of row `y` of the image, counted from the bottom. With a = (2 (y + 1/2) / height - 1) /
/// tanHalfY, the sine of the row's elevation is (middle + a perHeight) / sqrt(1 + a^2).
struct SkyRows {
    float middle = 0;    // sine of the elevation of the view direction
    float perHeight = 0; // sine of the elevation of the image's up direction
    float tanHalfY = 0;
};

/// Returns the sky parameters of the image, or nullopt if the background is not a sky.
std::optional<SkyRows> skyRows(const DrawInputs& frame);

/// Returns the displayed sky colour at an elevation. `sine` is the sine of the elevation, in [-1, 1].
Rgb skyColor(double sine);

/// Returns true if the image of `frame` has a transparent background.
bool isTransparent(const DrawInputs& frame);

/// Returns the fraction of light that horizontal ground in shadow still receives, per channel. Each fraction is greater
/// than 0.
glm::vec3 leftInShadow(const DrawInputs& frame);

/// The fractions of sunlight and skylight on unoccluded horizontal ground, if the sky is sampled by directions.
struct GroundShares {
    glm::vec3 sun{0};
    glm::vec3 sky{0};
};

GroundShares groundShares(const DrawInputs& frame);

/// Returns the background colours `rows` darkened by a shadow on the ground. `left` is the remaining fraction of light
/// per channel.
std::vector<Rgb> shadowedRows(std::vector<Rgb> rows, const glm::vec3& left);

} // namespace gnomon::render
