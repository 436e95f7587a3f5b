// The shadow maps in a backend's depth texture, and the choice of the maps that a frame can reuse.
#pragma once

#include "frame/frame_options.h"
#include "frame/prepared_frame.h"

#include <vector>

namespace gnomon::frame {

/// All inputs besides the plan that determine the map lookups of an image. Culled maps are valid only for an equal
/// image.
struct MappedImage {
    FrameOptions options;
    bool usesHeadlight = false;
    std::vector<glm::dvec3> ground; // its outline; empty without a ground
    lod::DrawLists lists;

    bool operator==(const MappedImage&) const = default;
};

/// The maps of one frame in the depth texture. They are the key to the texels of the backend.
struct DrawnMaps {
    plan::FramePlan plan;
    MappedImage image;
    bool isCulled = false; // true: the maps lack the casters that the image does not look up
};

/// Returns the image of `frame` with `options`.
MappedImage mappedImage(const PreparedFrame& frame, const FrameOptions& options);

/// Marks the passes of `frame` that can use `maps` for an image with `options`. All other passes must be drawn. `maps`
/// can be null.
void decideMapReuse(PreparedFrame& frame, const FrameOptions& options, const DrawnMaps* maps);

} // namespace gnomon::frame
