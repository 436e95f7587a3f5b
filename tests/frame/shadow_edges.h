// The distance between shadow edges in two pictures of the same view, for example with different levels of detail.
#pragma once

#include "frame/renderer.h"

#include <vector>

namespace gnomon::tests {

/// The state of a sample's light.
enum class Reach : std::uint8_t {
    Nothing, // no surface
    Turned,  // the surface faces away from the light
    Dark,    // the light is occluded
    Lit
};

/// A sample of a picture for the detection of edges. A pixel has several samples.
struct ReachSample {
    Reach reach = Reach::Nothing;
    float sine = 0;  // sine of the angle between light and triangle; 0 if it faces away
    float depth = 0; // along the view axis
};

/// Samples in rows of `width` samples.
struct ReachPicture {
    std::size_t width = 0;
    std::vector<ReachSample> samples;
};

/// Min sine (ten degrees). At a smaller angle, a bump of the surface moves an edge by more than six times its height,
/// so edges there are not compared.
inline constexpr float kMinSine = 0.1736F;

/// Returns 1 for each sample on a compared shadow edge, otherwise 0. Such an edge has a dark sample next to a lit one
/// of the same surface, and the light meets both at ten degrees or more.
std::vector<std::uint8_t> shadowEdges(const ReachPicture& picture);

/// Returns 1 for each sample at which light ends on a surface, otherwise 0: unlit samples next to lit ones of the same
/// surface, for any reason and at any angle. The result includes all `shadowEdges`.
std::vector<std::uint8_t> lightEnds(const ReachPicture& picture);

/// Returns the distance from each of `shadowEdges` of `picture` to the nearest of `lightEnds` of `other`, in samples.
/// The distance is the diagonal if `other` has none, and negative without an edge. `lightEnds` is used because an edge
/// at eleven degrees in `picture` can be at nine degrees in `other`, or where its surface faces away from the light.
std::vector<float> edgeDistances(const ReachPicture& picture, const ReachPicture& other);

/// A view drawn with exact shadows, and its frame.
struct DrawnReach {
    frame::PreparedFrame frame;
    render::Raster<render::SurfaceSample> surfaces;
    ReachPicture picture;
};

/// Draws `view` at `errorPixels`, with `samples` x `samples` samples per pixel. `aside` shifts all samples, by at most
/// half a sample.
DrawnReach drawReach(
    frame::Renderer& renderer, plan::View view, double errorPixels, int samples, const glm::dvec2& aside = {});

} // namespace gnomon::tests
