// Describes the shadow maps in a backend's depth texture, and finds the maps that the next frame can reuse.
#pragma once

#include "frame/frame_options.h"
#include "frame/prepared_frame.h"

#include <vector>

namespace gnomon::frame {

/// The inputs, besides the plan, that determine at which points an image looks up its shadow maps. Maps whose casters
/// were culled by receivers are valid only for an image with equal inputs.
struct MappedImage {
    FrameOptions options;
    bool usesHeadlight = false;
    std::vector<glm::dvec3> ground; // outline of the ground in world space; empty without a ground
    lod::DrawLists lists;

    bool operator==(const MappedImage&) const = default;
};

/// The shadow maps that one frame drew into the backend's depth texture. A later frame compares their plan with its own
/// plan to find the maps that it can reuse.
struct DrawnMaps {
    plan::FramePlan plan;
    MappedImage image;
    bool isCulled = false; // true: casters that cannot change any shadow lookup of the image are missing in the maps
};

/// Returns the inputs that determine the shadow lookups of `frame`, drawn with `options`.
MappedImage mappedImage(const PreparedFrame& frame, const FrameOptions& options);

/// Marks the shadow passes of `frame` whose maps are already in the depth texture, as described by `maps`. The caller
/// must draw the maps of all other passes. `options` are the options of the frame. If `maps` is null, no pass is
/// marked.
void decideMapReuse(PreparedFrame& frame, const FrameOptions& options, const DrawnMaps* maps);

} // namespace gnomon::frame
