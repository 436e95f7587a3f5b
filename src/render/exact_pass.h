// Converts the clusters, the light and the sample grid of a frame to the input of exact shadows.
#pragma once

#include "exact/exact_shadows.h"
#include "exact/visible_points.h"
#include "render/image_pass.h"

#include <vector>

namespace gnomon::render {

/// Returns the values that all samples of a frame share: the light and the coordinate system.
exact::SampleSpace sampleSpace(const DrawInputs& frame);

/// Returns the tolerance of exact shadows for `light`: two grid steps. A triangle that is nearer to a point than the
/// tolerance does not shadow the point. The unit is that of exact::intersect.
std::uint32_t tolerance(const IntegerLight& light);

/// Draws the visible triangles of `frame`, and adds the visible points that face the light to `samples`. Returns the
/// same counts as drawVisible. The picture stays unchanged.
std::optional<raster::OcclusionCounts> collectSamples(
    const DrawInputs& frame, const ImageBuffers& buffers, exact::SampleList& samples, UnresolvedPixels& unresolved);

/// Draws the image of `frame` as if all surfaces were in shadow, and stores all visible points in `points`. The points
/// can then be tested against any light.
void drawPoints(const DrawInputs& frame, const ImageBuffers& buffers, exact::VisiblePoints& points);

/// Collects all casters of exact shadows: first the clusters of the image pass in their order, then the other clusters
/// of `frame.exactCasters`. Overwrites `casters`. If sections cut casters, the function adds the pieces of the other
/// clusters to the pass. Otherwise a cluster of the image that sections cut casts the shadow of the whole cluster.
void gatherExactCasters(const DrawInputs& frame, SoftwarePass& image, std::vector<exact::Caster>& casters);

/// Returns the homographies from the light plane to the cells of the sample grid, one per map of the plan. The list is
/// empty for a point light.
std::vector<glm::dmat3> cellPlanes(const DrawInputs& frame, const exact::LightShear& shear);

/// Computes the lit pixels of `frame` with the simple loops of exact::plainStatuses: 255 if lit, otherwise 0. The
/// result is the ground truth for all backends. Casters are the clusters of `frame.image` and `frame.exactCasters`.
Raster<std::uint8_t> litByIntegers(const DrawInputs& frame);

} // namespace gnomon::render
