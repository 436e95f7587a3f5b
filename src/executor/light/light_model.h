// How much light a surface gets and which colour a screen shows for it: linear light through a shoulder and the
// transfer function of sRGB. Sums, products, quotients and square roots alone, so that every compiler finds the same.
#pragma once

#include "plan/frame_plan.h"
#include "shaders/shared/frame_block.h"

#include <array>

namespace gnomon::executor {

/// sRGB (IEC 61966-2-1) in polynomials, off by less than a third of a level of 255: a byte that is made linear and
/// turned back is the same byte. `kFromDisplay` are those of the displayed value, `kToDisplay` those of the square root
/// of the linear one, lowest first; below the limits both are straight lines.
namespace srgb {
constexpr float kLinearSlope = 12.92F;
constexpr float kDisplayLimit = 0.04045F;
constexpr float kLinearLimit = 0.0031308F;
constexpr std::array<float, 5> kFromDisplay = {0.00106078186F, 0.0279601052F, 0.563798591F, 0.518328812F, -0.11114829F};
constexpr std::array<float, 5> kToDisplay = {-0.0367864106F, 1.44343967F, -0.92177175F, 0.801877223F, -0.286758735F};
} // namespace srgb

/// The displayed value in [0, 1] of a linear one in [0, 1].
float displayFromLinear(float linear);

/// The linear value in [0, 1] of a displayed one in [0, 1].
float linearFromDisplay(float display);

/// How bright a surface is shown that reflects `light`, linear, in [0, 1]: Reinhard's operator (Reinhard et al. 2002,
/// Eq 3), which leaves the dark nearly as it is and keeps differences where there is much light. Without light of the
/// picture's own, `--shading unlit`, what a surface reflects is what is shown.
float shoulder(const block::Frame& block, float light);

/// Fills the part of `block` that says how surfaces are lit; `shading` is never Auto.
void setLight(const plan::View& view, const plan::Look& look, plan::Shading shading, block::Frame& block);

/// Takes the light of the sky out of what setLight put into `block`, so that its directions make it up one by one.
void takeSkyOut(const plan::Look& look, block::Frame& block);

/// Leaves of the light in `block` what the sky sends from the direction of the light, one of many over the half sphere
/// about up, whose mean is to be the sky's: each counts `weight`, twice what is bright there (the mean over the half
/// sphere of twice the cosine is 1).
void leaveSkyDirection(const plan::Look& look, double weight, block::Frame& block);

} // namespace gnomon::executor
