// A frame's clusters, light and cells as exact shadows take them.
#pragma once

#include "exact/exact_shadows.h"
#include "exact/visible_points.h"
#include "executor/image_pass.h"

#include <vector>

namespace gnomon::executor {

/// What all samples of a frame share.
exact::SampleSpace sampleSpace(const FrameDrawing& frame);

/// How far ahead of any point a triangle may lie and still only touch it, as exact::meet takes it: two steps of the
/// grid.
std::uint32_t tolerance(const IntegerLight& light);

/// Draws the image of `frame` in shadow, and collects in `samples` the points that face the light. Answers what
/// drawVisible does.
std::optional<raster::OcclusionCounts> drawUndecided(
    const FrameDrawing& frame, const ImageBuffers& buffers, exact::SampleList& samples, UndecidedPixels& undecided);

/// Draws the image of `frame` in shadow, and collects in `points` all that is visible, to be asked of any light.
void drawPoints(const FrameDrawing& frame, const ImageBuffers& buffers, exact::VisiblePoints& points);

/// All that can cast: the clusters of the image's pass in their order, then those of `frame.exactCasters` that are not
/// among them. What `casters` held is overwritten. Where sections cut casters, pieces of the latter are added to the
/// pass; where they do not, the clusters that pieces are of cast whole.
void gatherExactCasters(const FrameDrawing& frame, SoftwarePass& image, std::vector<exact::Caster>& casters);

/// From the light plane to the cells of each of the plan's cell maps; none of a point light.
std::vector<glm::dmat3> cellPlanes(const FrameDrawing& frame, const exact::LightShear& shear);

/// Where the light reaches in the image of `frame`, 255 there and else 0, by the plain loops of exact::plainStatuses:
/// the truth, whatever drew the frame. Casters are those of `frame.image` and `frame.exactCasters`.
Raster<std::uint8_t> litByIntegers(const FrameDrawing& frame);

} // namespace gnomon::executor
