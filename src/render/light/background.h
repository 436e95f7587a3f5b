// The background of an image, with one colour per row.
#pragma once

#include "render/backend.h"

#include <optional>
#include <vector>

namespace gnomon::render {

/// Returns the colours of the image's rows, from top to bottom, for the camera that draws the image. The sky colour of
/// a row belongs to the direction through the row's middle. A transparent background is black.
std::vector<Rgb> backgroundRows(const DrawInputs& frame);

/// Parameters of the sky colour of row `y`, counted from the bottom. With a = (2 (y + 1/2) / height - 1) tanHalfY, the
/// sine of the elevation is (middle + a perHeight) / sqrt(1 + a^2).
struct SkyRows {
    float middle = 0;    // sine of the elevation of the view direction
    float perHeight = 0; // sine of the elevation of the image's up direction
    float tanHalfY = 0;
};

/// Returns the parameters, or nullopt if the background is not a sky.
std::optional<SkyRows> skyRows(const DrawInputs& frame);

/// Returns the displayed colour of the sky for a sine of elevation in [-1, 1].
Rgb skyColor(double sine);

/// Returns true if the background is transparent.
bool isTransparent(const DrawInputs& frame);

/// Returns the share of light, per channel, that remains in a shadow on level ground. Each value is greater than 0.
glm::vec3 leftInShadow(const DrawInputs& frame);

/// The shares of sun and sky in the light of unoccluded level ground, if the light of the sky comes from directions.
struct GroundShares {
    glm::vec3 sun{0};
    glm::vec3 sky{0};
};

GroundShares groundShares(const DrawInputs& frame);

/// Returns `rows` with the share `left` of their light.
std::vector<Rgb> shadowedRows(std::vector<Rgb> rows, const glm::vec3& left);

} // namespace gnomon::render
