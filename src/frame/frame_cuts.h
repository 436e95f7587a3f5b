// Computes the two cuts (selections of clusters) of a frame. The first cut contains the clusters of the image and its
// possible casters, and provides the scene facts for the plan. The second cut contains the clusters of the image and
// the casters of each planned shadow map.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"

namespace gnomon::frame {

/// Returns the input with which lod::cutFrame selects the clusters of `frame`.
lod::CutQuery cutQuery(const Residency& residency, const PreparedFrame& frame);

/// The view for which clusters are selected, and the margin around its image in which clusters are also selected.
struct CutView {
    const plan::View& view;
    double margin = 0; // pixels on each side of the image
};

/// Selects the clusters of the image of `frame`, with the error limit `frame.errorPixels`. Also sets `frame.rule` and
/// `frame.volumes`. If `quality` has a cap on triangles, the function can increase the error limit. If `range` (the
/// result of plan::widestRange) is given, the selection also includes all casters that can throw a shadow onto a
/// visible point whose depth is in `range`.
void cutImage(
    PreparedFrame& frame,
    const CutView& cutView,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range,
    const Residency& residency,
    const hierarchy::Grid& grid);

/// Intersects the receiver volume `receivers` with the model's bounding box, because there are no receivers outside.
/// `receivers` is in local space, whose origin is `origin` in world space.
void clipToModel(const Box& model, const glm::dvec3& origin, ConvexVolume& receivers);

/// Adds one volume per section plane of `frame`, which extends 4 grid steps to each side of the plane. If the removed
/// side casts no shadows, also clips the caster volumes by the planes. `origin` is the origin of local space, in world
/// space. Throws Error if the number of volumes exceeds lod::kMaxVolumes.
void addSections(PreparedFrame& frame, const glm::dvec3& origin);

/// Selects the clusters of the image and the casters of each planned shadow map. Casters can require more detail than
/// the image. With a cap on triangles, the function can increase `frame.errorPixels`.
void cutPartitions(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
