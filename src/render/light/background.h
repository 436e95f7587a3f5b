// The background of an image, with one colour per row.
#pragma once

#include "render/backend.h"

#include <optional>
#include <vector>

namespace gnomon::render {

/// Returns one colour per row of the image, from top to bottom, for the camera that draws the image. The sky colour of
/// a row is the colour in the direction through the middle of the row. A transparent background is black.
std::vector<Rgb> backgroundRows(const DrawInputs& frame);

/// Parameters for the sky colour of row `y` of the image, counted from the bottom. With a = (2 (y + 1/2) / height - 1)
/// tanHalfY, the sine of the row's elevation is (middle + a perHeight) / sqrt(1 + a^2).
struct SkyRows {
    float middle = 0;    // sine of the elevation of the view direction
    float perHeight = 0; // sine of the elevation of the image's up direction
    float tanHalfY = 0;
};

/// Returns the parameters of the sky colours, or nullopt if the background is not a sky.
std::optional<SkyRows> skyRows(const DrawInputs& frame);

/// Returns the displayed colour of the sky for the sine of an elevation, in [-1, 1].
Rgb skyColor(double sine);

/// Returns true if the background is transparent.
bool isTransparent(const DrawInputs& frame);

/// Returns the fraction of light, per channel, that horizontal ground in shadow still receives. Each value is greater
/// than 0.
glm::vec3 leftInShadow(const DrawInputs& frame);

/// The fractions of sun and sky in the light of unoccluded horizontal ground, if the sky is sampled by directions.
struct GroundShares {
    glm::vec3 sun{0};
    glm::vec3 sky{0};
};

GroundShares groundShares(const DrawInputs& frame);

/// Returns the background colours `rows` in a ground shadow that leaves the fraction `left` of their light, per
/// channel.
std::vector<Rgb> shadowedRows(std::vector<Rgb> rows, const glm::vec3& left);

} // namespace gnomon::render
