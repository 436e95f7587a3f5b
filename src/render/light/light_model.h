// Computes the displayed colour of a surface from its light: linear light, tone mapping and the sRGB transfer
// function. All functions use only sums, products, quotients and square roots, so all compilers give the same result.
#pragma once

#include "plan/frame_plan.h"
#include "shaders/shared/frame_block.h"

#include <array>

namespace gnomon::render {

/// Polynomial approximations of the sRGB transfer function (IEC 61966-2-1). The error is less than a third of one of
/// 255 levels, so conversion to linear and back preserves each byte. `kFromDisplay` contains coefficients for powers of
/// the displayed value, and `kToDisplay` for powers of the square root of the linear value, lowest order first. Below
/// the limits both functions are linear.
namespace srgb {
constexpr float kLinearSlope = 12.92F;
constexpr float kDisplayLimit = 0.04045F;
constexpr float kLinearLimit = 0.0031308F;
constexpr std::array<float, 5> kFromDisplay = {0.00106078186F, 0.0279601052F, 0.563798591F, 0.518328812F, -0.11114829F};
constexpr std::array<float, 5> kToDisplay = {-0.0367864106F, 1.44343967F, -0.92177175F, 0.801877223F, -0.286758735F};
} // namespace srgb

/// Converts a linear value in [0, 1] to an sRGB value in [0, 1].
float displayFromLinear(float linear);

/// Converts an sRGB value in [0, 1] to a linear value in [0, 1].
float linearFromDisplay(float display);

/// Returns the tone-mapped value of the linear light `light`, in [0, 1], by Reinhard's operator (Reinhard et al. 2002,
/// Eq 3). Dark values stay almost unchanged, and differences between bright values stay visible. `--shading unlit`
/// disables tone mapping.
float toneMapped(const block::Frame& block, float light);

/// Writes the light parameters of a view to the uniform block `block`. `shading` must not be Auto.
void setLight(const plan::View& view, const plan::ShadingSettings& look, plan::Shading shading, block::Frame& block);

/// Removes the skylight from the light parameters in `block`. Separate frames, each with one sky direction, can then
/// add it.
void removeSkyLight(const plan::ShadingSettings& look, block::Frame& block);

/// Replaces all light in `block` by the skylight from one direction, the direction of the frame's light. The whole
/// skylight is the mean of many such directions over the hemisphere around up. `weight` is twice the relative
/// brightness of this direction, because the mean of twice the cosine over the hemisphere is 1.
void keepOnlySkyDirection(const plan::ShadingSettings& look, double weight, block::Frame& block);

} // namespace gnomon::render
