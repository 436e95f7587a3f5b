// Low-discrepancy sets of directions that sample the disc of the sun and the sky. The mean over a set approximates the
// light.
#pragma once

#include "plan/light_sampling.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon::plan {

/// A number of directions over a disc and its error. The error is the max difference, over all straight lines, between
/// the share of directions on one side and the share of the disc's area there. It is the largest error of the lit share
/// of a point that a straight edge shadows.
struct DiscSampling {
    int directions = 1;
    double error = 1;
    /// Number of points that suffices if no penumbra is wider than one pixel: the first `first` points, or more. For a
    /// straight edge, the error of the mean over a pixel is then at most 0.106 of the penumbra's width. The centre of
    /// the disc alone has the same error.
    int first = 1;
};

/// The available numbers of directions, ascending.
extern const std::array<DiscSampling, 23> kDiscSamplings;

/// Returns the smallest number of directions whose error is at most 0.85 of `lightError`. The subpixel positions of the
/// frames cause the remaining error. Returns the largest number in the table if all errors are too large.
int directionsFor(double lightError);

/// Returns the penumbra width, in pixels perpendicular to the beam, up to which a point light replaces the disc. The
/// error of the mean over a pixel is then at most `lightError` of full light. For a straight edge, this error is at
/// most 2 / (3 pi) of half the width. On a slanted surface the penumbra is wider, but the cosine reduces the light by
/// the same factor.
double minPenumbra(double lightError);

/// Returns point `i` of `count` (i < count) in a disc of radius 1 (Vogel 1979). The first point is the centre.
/// Consecutive points are far apart, so the first few points are also evenly distributed. The order also fits the pixel
/// positions of frame::subpixelOffset with the same number.
glm::dvec2 discPoint(int i, int count);

/// Returns DiscSampling::first for `directions`, or `directions` if the table does not contain this number.
int minFirstPoints(int directions);

/// Returns the unit direction through `point` of the light's disc. The disc has the centre direction `middle`, of any
/// length above 0, and the angular diameter `angleRadians`.
glm::dvec3 towardsDisc(const glm::dvec3& middle, double angleRadians, const glm::dvec2& point);

/// A part of the sky with its unit direction and its weight, which is twice its brightness. The mean of weight times
/// cosine over all parts is the light of a surface that sees the whole sky. This mean is 1 for a level surface.
struct SkyPart {
    glm::dvec3 direction{0, 1, 0};
    double weight = 2;
};

/// Returns part `i` of `count` around `up`, which has any length above 0. All parts have the same solid angle
/// (Fibonacci lattice).
SkyPart skyPart(int i, int count, SkyModel model, const glm::dvec3& up);

/// Returns the mean of weight times cosine over `count` parts for a level surface. The result is close to 1.
double levelSkyLight(int count, SkyModel model);

/// Returns the max error of a surface's light from the mean over `parts` directions. 1 is the light of a level surface
/// that sees the whole sky. The estimate is for a sky behind at most two straight edges. It grows with the max
/// brightness of the sky, which is 9/7 for an overcast sky.
double skyError(int parts, SkyModel model);

} // namespace gnomon::plan
