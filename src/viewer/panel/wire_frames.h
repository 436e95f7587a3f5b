// Convex volumes as wire frames: their edges, and where those fall on a picture.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "plan/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::viewer {

using Segment = std::array<glm::dvec3, 2>;

/// The edges of `volume` cut to `limit`, those of the cut included: every piece of a line in which two of its planes
/// meet that lies inside all others. Planes that coincide give an edge more than once.
std::vector<Segment> edges(const ConvexVolume& volume, const ConvexVolume& limit);

/// The planes of `box`.
ConvexVolume volumeOf(const Box& box);

/// `volume`, in camera space, in world space.
ConvexVolume inWorld(const ConvexVolume& volume, const Camera& camera);

/// A volume of a plan as a wire frame in world space.
struct PlanVolume {
    enum class Kind : std::uint8_t { View, Partition, Casters };
    Kind kind = Kind::View;
    std::size_t index = 0; // of the pass
    std::vector<Segment> edges;
};

/// The part of the view that shadows are promised for, each partition and each partition's casters, cut to `bounds`
/// and the eye.
std::vector<PlanVolume> planVolumes(const plan::FramePlan& plan, const Box& bounds);

/// A picture to fall on.
struct PictureFrame {
    Camera camera;
    int width = 1; // pixels
    int height = 1;
};

using PixelSegment = std::array<glm::dvec2, 2>;

/// `segments` (world space) on `frame`, in pixels from its upper left corner, cut at a plane just before the eye.
std::vector<PixelSegment> onPicture(std::span<const Segment> segments, const PictureFrame& frame);

} // namespace gnomon::viewer
