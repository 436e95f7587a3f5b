// Directions that stand for the disc of the sun and for the sky: low-discrepancy sets, whose mean is the light.
#pragma once

#include "plan/light_sampling.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon::plan {

/// A number of directions over a disc, and how far the share of them on one side of any line may be from that of the
/// disc: the largest error of a point's lit share where a straight edge shadows it.
struct DiscSampling {
    int directions = 1;
    double error = 1;
    /// So many of the first points, or more, stand for the disc beside a penumbra at most a pixel wide: where a
    /// straight edge casts it, the mean over a pixel is off by at most 0.106 of the width, as it is of the middle
    /// alone.
    int first = 1;
};

/// The numbers of directions that are chosen among, rising.
extern const std::array<DiscSampling, 23> kDiscSamplings;

/// The fewest directions whose error is at most 0.85 of `lightError`, what the places of the frames within the pixels
/// leave of it; the most there are where none are enough.
int directionsFor(double lightError);

/// The width of a penumbra, in pixels across the beam, that a point light is as good as, within `lightError` of full
/// light in the mean over a pixel: along a straight edge the two differ there by at most 2 / (3 pi) of half the width.
/// What a surface that slants away from the light stretches a penumbra by, its cosine takes off its light again.
double leastPenumbra(double lightError);

/// Point `i` of `count`, i < count, of a disc of radius 1 (Vogel 1979): the first is the middle, and those that follow
/// each other lie apart, so that few of them are spread as all are, and so that they go together with the places of
/// frame::subpixelOffset of the same number.
glm::dvec2 discPoint(int i, int count);

/// DiscSampling::first of so many directions; all of any other number.
int leastFirstPoints(int directions);

/// The direction, of unit length, through a point of the disc about `middle`, of any length above 0, that is
/// `angleRadians` across.
glm::dvec3 towardsDisc(const glm::dvec3& middle, double angleRadians, const glm::dvec2& point);

/// A part of the sky: its direction, of unit length, and what it weighs, twice its brightness. The mean of weight times
/// cosine over all of them is the light of a surface that sees all of the sky, 1 where it is level.
struct SkyPart {
    glm::dvec3 direction{0, 1, 0};
    double weight = 2;
};

/// Part `i` of `count`, of equal solid angles (a Fibonacci lattice), around `up`, of any length above 0.
SkyPart skyPart(int i, int count, SkyModel model, const glm::dvec3& up);

/// That mean: the lattice of `count` parts has it nearly.
double levelSkyLight(int count, SkyModel model);

/// How far the light of a surface may be off that is the mean over so many parts, 1 being that of a level one that sees
/// all of the sky: where straight edges, up to two, hide some of it. More, in as much as parts of an overcast sky are
/// brighter.
double skyError(int parts, SkyModel model);

} // namespace gnomon::plan
