// Computes the light of a surface and its displayed colour: linear light, tone mapping and the transfer function of
// sRGB. All functions use only sums, products, quotients and square roots, so all compilers give the same result.
#pragma once

#include "plan/frame_plan.h"
#include "shaders/shared/frame_block.h"

#include <array>

namespace gnomon::render {

/// Polynomial approximations of the sRGB transfer function (IEC 61966-2-1). The error is less than a third of a level
/// of 255, so a byte is unchanged after conversion to linear and back. `kFromDisplay` contains coefficients for powers
/// of the displayed value, and `kToDisplay` for powers of the square root of the linear value, lowest order first.
/// Below the limits both functions are linear.
namespace srgb {
constexpr float kLinearSlope = 12.92F;
constexpr float kDisplayLimit = 0.04045F;
constexpr float kLinearLimit = 0.0031308F;
constexpr std::array<float, 5> kFromDisplay = {0.00106078186F, 0.0279601052F, 0.563798591F, 0.518328812F, -0.11114829F};
constexpr std::array<float, 5> kToDisplay = {-0.0367864106F, 1.44343967F, -0.92177175F, 0.801877223F, -0.286758735F};
} // namespace srgb

/// Converts a linear value in [0, 1] to a displayed value in [0, 1].
float displayFromLinear(float linear);

/// Converts a displayed value in [0, 1] to a linear value in [0, 1].
float linearFromDisplay(float display);

/// Returns the tone-mapped value, in [0, 1], of the linear light `light`, by Reinhard's operator (Reinhard et al. 2002,
/// Eq 3). The operator keeps dark values almost unchanged, and keeps differences between bright values visible. With
/// `--shading unlit`, there is no tone mapping.
float toneMapped(const block::Frame& block, float light);

/// Sets the light parameters of the uniform block `block`. `shading` must not be Auto.
void setLight(const plan::View& view, const plan::ShadingSettings& look, plan::Shading shading, block::Frame& block);

/// Removes the sky light from the parameters in `block`, so that frames with single sky directions can add it.
void removeSkyLight(const plan::ShadingSettings& look, block::Frame& block);

/// Replaces the light in `block` by the sky light from one direction, the direction of the frame's light. The whole sky
/// light is the mean of many such directions over the hemisphere around up. `weight` is twice the relative brightness
/// of this direction, because the mean of twice the cosine over the hemisphere is 1.
void keepOnlySkyDirection(const plan::ShadingSettings& look, double weight, block::Frame& block);

} // namespace gnomon::render
