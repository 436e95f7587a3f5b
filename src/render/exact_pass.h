// Conversion of a frame's clusters, light and sample grid to the input of exact shadows.
#pragma once

#include "exact/exact_shadows.h"
#include "exact/visible_points.h"
#include "render/image_pass.h"

#include <vector>

namespace gnomon::render {

/// Returns the light and the coordinate system that all samples of a frame share.
exact::SampleSpace sampleSpace(const DrawInputs& frame);

/// Returns the tolerance of exact shadows: triangles within two grid steps in front of a point do not shadow it. The
/// unit is that of exact::intersect.
std::uint32_t tolerance(const IntegerLight& light);

/// Finds the visible triangles of `frame` and collects the points that face the light in `samples`. Returns the same
/// counts as drawVisible. The picture stays unchanged.
std::optional<raster::OcclusionCounts> collectSamples(
    const DrawInputs& frame, const ImageBuffers& buffers, exact::SampleList& samples, UnresolvedPixels& unresolved);

/// Draws the image of `frame` as if all surfaces were in shadow, and collects all visible points in `points`. They can
/// then be tested against any light.
void drawPoints(const DrawInputs& frame, const ImageBuffers& buffers, exact::VisiblePoints& points);

/// Collects all casters: first the clusters of the image's pass in their order, then the other clusters of
/// `frame.exactCasters`. Overwrites `casters`. If sections cut casters, adds the pieces of the other clusters to the
/// pass. If not, a cut cluster of the image casts its whole shadow.
void gatherExactCasters(const DrawInputs& frame, SoftwarePass& image, std::vector<exact::Caster>& casters);

/// Returns the transformation from the light plane to the bins of each map of the plan. The list is empty for a point
/// light.
std::vector<glm::dmat3> cellPlanes(const DrawInputs& frame, const exact::LightShear& shear);

/// Computes the lit pixels of `frame` with the simple loops of exact::plainStatuses: 255 if lit, otherwise 0. This is
/// the ground truth for all backends. Casters are `frame.image` and `frame.exactCasters`.
Raster<std::uint8_t> litByIntegers(const DrawInputs& frame);

} // namespace gnomon::render
