// Computes wire frames of convex volumes such as the view frustum: their edges, and the projection of the edges onto
// an image.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "plan/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::viewer {

using Segment = std::array<glm::dvec3, 2>;

/// Returns the edges of the intersection of the convex volumes `volume` and `limit`. An edge is the part of the
/// intersection line of two planes that is inside all other planes. Coincident planes produce an edge repeatedly.
std::vector<Segment> edges(const ConvexVolume& volume, const ConvexVolume& limit);

/// Returns the convex volume of the six planes of `box`.
ConvexVolume volumeOf(const Box& box);

/// Transforms a convex volume from the camera space of `camera` to world space.
ConvexVolume inWorld(const ConvexVolume& volume, const Camera& camera);

/// The wire frame of a volume that the plan of a frame uses, in world space.
struct PlanVolume {
    enum class Kind : std::uint8_t { View, Partition, Casters };
    Kind kind = Kind::View;
    std::size_t index = 0; // index of the pass
    std::vector<Segment> edges;
};

/// Returns wire frames of the volumes that `plan` uses: the part of the view with guaranteed shadow resolution, each
/// partition of the view, and the volume of the shadow casters of each partition. All are clipped to `bounds` and the
/// eye.
std::vector<PlanVolume> planVolumes(const plan::FramePlan& plan, const Box& bounds);

/// The camera and the size of an image onto which line segments are projected.
struct PictureFrame {
    Camera camera;
    int width = 1; // pixels
    int height = 1;
};

using PixelSegment = std::array<glm::dvec2, 2>;

/// Projects the world-space `segments` onto an image. The results are in pixels from the upper left corner of `frame`.
/// The segments are clipped at a plane just in front of the eye.
std::vector<PixelSegment> onPicture(std::span<const Segment> segments, const PictureFrame& frame);

} // namespace gnomon::viewer
