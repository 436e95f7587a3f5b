// The shadow maps that are still in the executor's depth texture, and the decision which of them a frame uses again.
#pragma once

#include "frame/frame_options.h"
#include "frame/prepared_frame.h"

#include <optional>
#include <vector>

namespace gnomon::frame {

/// The maps that the last frame left in the depth texture.
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
    /// Everything that an image looks up its maps by, besides its plan. Culled maps are valid only for an equal image.
    struct Image {
        FrameOptions options;
        bool isSunless = false;
        std::vector<glm::dvec3> ground;                             // its outline; empty without ground
        std::vector<std::vector<selection::ClusterRange>> clusters; // of all draw lists, the image's first

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
