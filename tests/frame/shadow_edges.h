// How far edges of shadows lie from those of another picture of the same view, of another level of detail, say.
#pragma once

#include "frame/renderer.h"

#include <vector>

namespace gnomon::tests {

/// Which part of the light a sample gets.
enum class Reach : std::uint8_t {
    Nothing, // no surface is seen
    Turned,  // the surface is turned from the light
    Dark,    // something else is in the way
    Lit
};

/// What an edge is told by, a sample of a picture each; several make a pixel.
struct ReachSample {
    Reach reach = Reach::Nothing;
    float sine = 0;  // of the angle at which the light meets the drawn triangle; 0 where it is turned
    float depth = 0; // along the view axis
};

/// Samples `width` a row.
struct ReachPicture {
    std::size_t width = 0;
    std::vector<ReachSample> samples;
};

/// Below ten degrees the least bump of a surface moves an edge by six times its height: no edge is asked for there.
inline constexpr float kLeastSine = 0.1736F;

/// Where a picture has an edge of a shadow that is asked for: a dark sample beside a lit one of the same surface, both
/// of which the light meets at ten degrees or more. 1, else 0.
std::vector<std::uint8_t> shadowEdges(const ReachPicture& picture);

/// Where light ends on a surface, for whatever reason and at whatever angle: samples that are not lit beside lit ones
/// of the same surface. All of `shadowEdges` are there. 1, else 0.
std::vector<std::uint8_t> lightEnds(const ReachPicture& picture);

/// From each of `shadowEdges` of `picture` to the nearest of `lightEnds` of `other`, by sample, in samples; the
/// diagonal where `other` has none, below 0 where there is no edge. What is an edge at eleven degrees here may lie at
/// nine in `other`, or where its surface turns from the light: it has not gone, so these count there.
std::vector<float> edgeDistances(const ReachPicture& picture, const ReachPicture& other);

/// A view drawn with exact shadows, and what its frame was.
struct DrawnReach {
    frame::PreparedFrame frame;
    executor::Raster<executor::SurfaceSample> surfaces;
    ReachPicture picture;
};

/// Draws `view`, with `samples` along each side of a pixel, at `errorPixels`. `aside` is how far from their places all
/// samples are, in samples, at most half.
DrawnReach drawReach(
    frame::Renderer& renderer, plan::View view, double errorPixels, int samples, const glm::dvec2& aside = {});

} // namespace gnomon::tests
