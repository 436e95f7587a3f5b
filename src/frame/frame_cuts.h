// The two cuts of a frame. The first cut contains the image and its possible casters, and provides the facts for the
// plan. The second cut contains the image and the casters of each pass of the plan.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"

namespace gnomon::frame {

/// Returns the query that computes the cut of `frame`.
lod::CutQuery cutQuery(const Residency& residency, const PreparedFrame& frame);

/// An image whose cut extends beyond its edges.
struct CutView {
    const plan::View& view;
    double margin = 0; // pixels on each side of the image
};

/// Cuts the image of `cutView` with the error limit `errorPixels` of `frame`, and sets the error rule and the volumes.
/// A cap on triangles in `quality` can increase the limit. If `range` (the result of widestRange) is given, the second
/// volume contains all casters that can throw a shadow into it.
void cutImage(
    PreparedFrame& frame,
    const CutView& cutView,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range,
    const Residency& residency,
    const hierarchy::Grid& grid);

/// Clips `receivers` to the bounds of the model, because surfaces outside the model receive no shadow. `receivers` is
/// in local space, whose origin is `origin` in world space.
void clipToModel(const Box& model, const glm::dvec3& origin, ConvexVolume& receivers);

/// Clips the caster volumes of `frame` by the section planes if the sections remove casters. Adds one volume per
/// section plane, which extends 4 grid steps to each side of the plane. `origin` is the origin of local space in world
/// space. Throws Error if the number of volumes exceeds lod::kMaxVolumes.
void addSections(PreparedFrame& frame, const glm::dvec3& origin);

/// Cuts a planned frame again: the image, and the casters of each pass, culled to its partition. Casters can require
/// more detail than the image. Under a cap on triangles, this can increase `errorPixels`.
void cutPartitions(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
