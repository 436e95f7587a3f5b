// Wire frames of convex volumes such as the view frustum: their edges, and the projection of the edges onto an image.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "plan/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::viewer {

using Segment = std::array<glm::dvec3, 2>;

/// Returns the edges of the intersection of `volume` and `limit`. An edge is the part of the intersection line of two
/// planes that is inside all other planes. Coincident planes produce an edge repeatedly.
std::vector<Segment> edges(const ConvexVolume& volume, const ConvexVolume& limit);

/// Returns the planes of `box`.
ConvexVolume volumeOf(const Box& box);

/// Converts a volume from camera space to world space.
ConvexVolume inWorld(const ConvexVolume& volume, const Camera& camera);

/// The wire frame of a volume of the plan, in world space.
struct PlanVolume {
    enum class Kind : std::uint8_t { View, Partition, Casters };
    Kind kind = Kind::View;
    std::size_t index = 0; // index of the pass
    std::vector<Segment> edges;
};

/// Returns the part of the view with guaranteed shadow resolution, each partition, and the volume of the casters of
/// each partition. All are clipped to `bounds` and the eye.
std::vector<PlanVolume> planVolumes(const plan::FramePlan& plan, const Box& bounds);

/// An image that segments are projected onto.
struct PictureFrame {
    Camera camera;
    int width = 1; // pixels
    int height = 1;
};

using PixelSegment = std::array<glm::dvec2, 2>;

/// Projects `segments` (world space) onto `frame`, in pixels from its upper left corner. They are clipped at a plane
/// just in front of the eye.
std::vector<PixelSegment> onPicture(std::span<const Segment> segments, const PictureFrame& frame);

} // namespace gnomon::viewer
