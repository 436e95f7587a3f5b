// The shadow maps in a backend's depth texture, and the choice of the maps that a frame can reuse.
#pragma once

#include "frame/frame_options.h"
#include "frame/prepared_frame.h"

#include <vector>

namespace gnomon::frame {

/// All inputs of an image, besides the plan, that determine its lookups in the shadow maps. Maps that receivers culled
/// are valid only for an image with equal inputs.
struct MappedImage {
    FrameOptions options;
    bool usesHeadlight = false;
    std::vector<glm::dvec3> ground; // outline of the ground in world space; empty without a ground
    lod::DrawLists lists;

    bool operator==(const MappedImage&) const = default;
};

/// Describes the shadow maps of one frame in the backend's depth texture. A frame compares it with its own plan to find
/// the maps that it can reuse.
struct DrawnMaps {
    plan::FramePlan plan;
    MappedImage image;
    bool isCulled = false; // true: casters that cannot change a lookup of the image were not drawn
};

/// Returns the inputs of the image of `frame` with `options`.
MappedImage mappedImage(const PreparedFrame& frame, const FrameOptions& options);

/// Marks the passes of `frame` whose maps are already in `maps`, for an image with `options`. The caller must draw all
/// other passes. `maps` can be null.
void decideMapReuse(PreparedFrame& frame, const FrameOptions& options, const DrawnMaps* maps);

} // namespace gnomon::frame
