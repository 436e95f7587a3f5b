// What is seen where no surface is: one colour a row of the image.
#pragma once

#include "executor/executor.h"

#include <optional>
#include <vector>

namespace gnomon::executor {

/// The colours of the image's rows, from top to bottom, as the camera that draws the image sees them: the sky is that
/// of the direction through the middle of a row. Black where the background is transparent.
std::vector<Rgb> backgroundRows(const FrameDrawing& frame);

/// What tells the sky of a row `y` of rows from the bottom: with a = (2 (y + 1/2) / height - 1) tanHalfY the sine to
/// the horizon is (middle + a perHeight) / sqrt(1 + a^2).
struct SkyRows {
    float middle = 0;    // the view's rise
    float perHeight = 0; // that of the picture's up
    float tanHalfY = 0;
};

/// Nothing where the background is no sky.
std::optional<SkyRows> skyRows(const FrameDrawing& frame);

/// The displayed colour of the sky in a direction whose sine to the horizon is `sine`, in [-1, 1].
Rgb skyColor(double sine);

/// Whether nothing lies behind the model.
bool isTransparent(const FrameDrawing& frame);

/// The share of the light of sun, sky and ground, each above 0, that a shadow on level ground leaves.
glm::vec3 leftInShadow(const FrameDrawing& frame);

/// The parts that the sun and the sky have in the light of level ground that sees all of both, where the sky's light
/// comes from directions.
struct GroundShares {
    glm::vec3 sun{0};
    glm::vec3 sky{0};
};

GroundShares groundShares(const FrameDrawing& frame);

/// `rows` with that share of their light.
std::vector<Rgb> shadowedRows(std::vector<Rgb> rows, const glm::vec3& left);

} // namespace gnomon::executor
