// The shadow maps that are still in the backend's depth texture, and the choice of the maps that a frame can reuse.
#pragma once

#include "frame/frame_options.h"
#include "frame/prepared_frame.h"

#include <optional>
#include <vector>

namespace gnomon::frame {

/// The maps of the last frame in the depth texture.
class HeldMaps {
public:
    /// Marks the passes of `frame` whose maps can be used again for an image with `options`. All other passes must be
    /// drawn.
    void mark(PreparedFrame& frame, const FrameOptions& options) const;

    /// Remembers that the texture holds the maps of `frame`. `isCulled` says that they lack the casters that its image
    /// with `options` does not look up.
    void hold(const PreparedFrame& frame, const FrameOptions& options, bool isCulled);

    /// Remembers that the texture holds no maps.
    void clear() { held_.reset(); }

private:
    /// All inputs besides the plan that determine the map lookups of an image. Culled maps are valid only for an equal
    /// image.
    struct Image {
        FrameOptions options;
        bool isSunless = false;
        std::vector<glm::dvec3> ground; // its outline; empty without a ground
        lod::DrawLists lists;

        bool operator==(const Image&) const = default;
    };

    struct Held {
        plan::FramePlan plan;
        Image image;
        bool isCulled = false;
    };

    static Image imageOf(const PreparedFrame& frame, const FrameOptions& options);

    std::optional<Held> held_;
};

} // namespace gnomon::frame
