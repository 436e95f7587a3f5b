// Prepares the input of exact shadows from a frame: the casters, the light and the visible points.
#pragma once

#include "exact/exact_shadows.h"
#include "exact/visible_points.h"
#include "render/image_pass.h"

#include <vector>

namespace gnomon::render {

/// Returns the light, the eye and the coordinate system for the exact shadows of `frame`.
exact::SampleSpace sampleSpace(const DrawInputs& frame);

/// Returns the distance of two grid steps along `light`, in the units of exact::intersect. With exact shadows, a
/// triangle nearer to a point than this distance does not shadow the point.
std::uint32_t tolerance(const IntegerLight& light);

/// Finds the visible triangles of `frame`, and adds the visible points that face the light to `samples`. If the plan
/// uses occlusion culling, returns the numbers of skipped clusters and triangles. The picture stays unchanged.
std::optional<raster::OcclusionCounts> collectSamples(
    const DrawInputs& frame, const ImageBuffers& buffers, exact::SampleList& samples, UnresolvedPixels& unresolved);

/// Draws the image of `frame` as if all surfaces were in shadow, and stores all visible points in `points`. Shadows of
/// these points can then be computed for any light.
void drawPoints(const DrawInputs& frame, const ImageBuffers& buffers, exact::VisiblePoints& points);

/// Collects all casters of exact shadows into `casters`: first the clusters of the image in their order, then the other
/// clusters of `frame.exactCasters`. If section planes cut casters, the function adds the cut pieces of the other
/// clusters to `image`. Otherwise a cluster that section planes cut casts the shadow of the whole cluster.
void gatherExactCasters(const DrawInputs& frame, SoftwarePass& image, std::vector<exact::Caster>& casters);

/// Returns one homography per shadow map of the plan: from the light plane to the cells of the sample grid. The list is
/// empty for a point light.
std::vector<glm::dmat3> cellPlanes(const DrawInputs& frame, const exact::LightShear& shear);

/// The status of a pixel without a sample: it shows no surface, or one that faces away from the light.
constexpr std::uint8_t kNoSample = 0xFF;

/// Computes the status of each pixel of `frame` by brute force with integers (exact::plainStatuses). The result is
/// kNoSample for pixels without a sample. This is the ground truth for all backends. Casters are the clusters of
/// `frame.image` and `frame.exactCasters`.
Raster<std::uint8_t> statusesByIntegers(const DrawInputs& frame);

/// Returns 255 for each pixel that is lit according to statusesByIntegers, otherwise 0.
Raster<std::uint8_t> litByIntegers(const DrawInputs& frame);

} // namespace gnomon::render
