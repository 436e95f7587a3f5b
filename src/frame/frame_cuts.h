// The two cuts of a frame. The first cut contains the clusters of the image and of its possible casters. It provides
// the scene facts for the plan. The second cut contains the clusters of the image and of the casters of each planned
// pass.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"

namespace gnomon::frame {

/// Returns the query that lod::cutFrame needs to compute the cut of `frame`.
lod::CutQuery cutQuery(const Residency& residency, const PreparedFrame& frame);

/// A view and a margin by which its cut extends beyond the edges of the image.
struct CutView {
    const plan::View& view;
    double margin = 0; // pixels on each side of the image
};

/// Computes the first cut of `frame` with the error limit `frame.errorPixels`, and sets the error rule and the volumes.
/// If `quality` has a cap on triangles, the function can increase the limit. If `range` (the result of
/// plan::widestRange) is given, the cut has a second volume. It contains all casters that can throw a shadow onto a
/// visible point in `range`.
void cutImage(
    PreparedFrame& frame,
    const CutView& cutView,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range,
    const Residency& residency,
    const hierarchy::Grid& grid);

/// Clips the receiver volume `receivers` to the bounds of the model, because there are no receivers outside.
/// `receivers` is in local space, whose origin is `origin` in world space.
void clipToModel(const Box& model, const glm::dvec3& origin, ConvexVolume& receivers);

/// If the sections of `frame` also remove casters, clips its caster volumes by the section planes. Also adds one volume
/// per section plane, which extends 4 grid steps to each side of the plane. `origin` is the origin of local space, in
/// world space. Throws Error if the number of volumes exceeds lod::kMaxVolumes.
void addSections(PreparedFrame& frame, const glm::dvec3& origin);

/// Computes the second cut of a planned frame: the image, and the casters of each pass that can shadow its partition.
/// Casters can require more detail than the image. Under a cap on triangles, this can increase `errorPixels`.
void cutPartitions(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
