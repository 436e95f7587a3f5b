// Computes evenly distributed light directions that sample the disc of the sun or the sky. The mean of the light over
// these directions approximates the light of the whole disc or sky.
#pragma once

#include "plan/light_sampling.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon::plan {

/// A number of sample directions over the sun's disc, and the error of this sampling. A straight edge divides the disc
/// into two parts. The error is the max difference, over all straight edges, between the fraction of directions in a
/// part and the fraction of the disc's area in this part. It is thus the max error of the lit fraction of a point that
/// is shadowed by a straight edge.
struct DiscSampling {
    int directions = 1;
    double error = 1;
    /// Number of samples from which on an image is good enough in pixels whose penumbrae are at most one pixel wide.
    /// For a straight edge, the error of a pixel's mean light is then at most 0.106 of the penumbra's width in pixels.
    /// The centre of the disc alone has the same error.
    int first = 1;
};

/// The available numbers of light directions for the sun's disc, ascending.
extern const std::array<DiscSampling, 23> kDiscSamplings;

/// Returns the smallest number of directions for which the sampling error of the sun's disc is at most 0.85 of
/// `lightError`. The rest of `lightError` is for the errors from the subpixel positions of the frames. Returns the
/// largest available number if all errors are too large.
int directionsFor(double lightError);

/// Returns the penumbra width below which the sun can be drawn as a point, in pixels perpendicular to the beam. The
/// error of a pixel's mean light is then at most `lightError`, as a fraction of full light. For a straight edge, this
/// error is at most 2 / (3 pi) of half the width. On a slanted surface the penumbra is wider, but the cosine reduces
/// the light by the same factor.
double minPenumbra(double lightError);

/// Returns sample `i` of `count` (i < count) in a disc of radius 1 (Vogel 1979). The first sample is the centre.
/// Consecutive samples are far apart, so the first few samples are also evenly distributed. Frame `i` of an averaged
/// image combines this sample with the subpixel position frame::subpixelOffset(i), and the order also distributes these
/// pairs evenly.
glm::dvec2 discPoint(int i, int count);

/// Returns the number of samples that suffices for pixels with narrow penumbrae (DiscSampling::first), for a disc with
/// `directions` samples. Returns `directions` if kDiscSamplings has no entry for `directions`.
int minFirstPoints(int directions);

/// Returns the unit direction towards a point of the light's disc. `point` is in a disc of radius 1. The light's disc
/// has the centre direction `middle`, of any length above 0, and the angular diameter `angleRadians`.
glm::dvec3 towardsDisc(const glm::dvec3& middle, double angleRadians, const glm::dvec2& point);

/// A sample direction of the sky (unit length) and its weight. The weight is twice the brightness of the sky in this
/// direction. The light of a surface that sees the whole sky is the mean of weight times cosine over all samples. This
/// mean is 1 for a horizontal surface.
struct SkyPart {
    glm::dvec3 direction{0, 1, 0};
    double weight = 2;
};

/// Returns sample `i` of `count` sky samples around the zenith direction `up`, which has any length above 0. All
/// samples represent the same solid angle (Fibonacci lattice).
SkyPart skyPart(int i, int count, SkyModel model, const glm::dvec3& up);

/// Returns the light that a horizontal surface receives from `count` sky samples: the mean of SkyPart::weight times
/// cosine. The result is close to 1.
double levelSkyLight(int count, SkyModel model);

/// Returns an estimate of the max error of a surface's sky light if `parts` sample directions replace the sky. The
/// error is relative to the light of a horizontal surface that sees the whole sky. The estimate assumes that at most
/// two straight edges occlude the sky. The error is proportional to the max brightness of the sky, which is 9/7 for an
/// overcast sky and 1 for a uniform sky.
double skyError(int parts, SkyModel model);

} // namespace gnomon::plan
