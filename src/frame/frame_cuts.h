// The cuts of a frame: first the image and what may shadow it, for the plan; then image and casters by the plan's
// passes.
#pragma once

#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"

namespace gnomon::frame {

/// The query whose answer is `frame`'s cut.
selection::CutQuery cutQuery(const Residency& residency, const PreparedFrame& frame);

/// An image, and what is cut around it.
struct CutView {
    const plan::View& view;
    double margin = 0; // pixels on each side
};

/// Chooses `frame`'s rule and cuts the image of `cutView` with its `errorPixels`, which a cap raises; with a `range`,
/// which widestRange answered, also all that can throw a shadow into it.
void cutImage(
    PreparedFrame& frame,
    const CutView& cutView,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range,
    const Residency& residency,
    const hierarchy::Grid& grid);

/// Leaves of `receivers`, local space, what lies in the model, whose local space begins at `origin`: nothing is
/// shadowed beyond it.
void clipToModel(const Box& model, const glm::dvec3& origin, ConvexVolume& receivers);

/// Leaves of the volumes of `frame` behind the image's what the sections of its plan's view leave, where those cut
/// casters, and adds the neighbourhood of each section plane, a few cells to each side; local space begins at `origin`.
/// Throws Error if that is more volumes than a cut takes.
void addSections(PreparedFrame& frame, const glm::dvec3& origin);

/// Cuts the image of a planned frame again with the casters of each of its passes, culled to its partition. Casters
/// that want more detail than the image may raise `errorPixels` under a cap.
void cutPartitions(PreparedFrame& frame, const Residency& residency);

} // namespace gnomon::frame
