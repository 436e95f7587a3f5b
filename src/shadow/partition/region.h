// Divides the view into convex regions (partitions) with one shadow map each, and assigns each point to exactly one of
// them. The partition is selected directly, without multiplying masks.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "core/depth_span.h"
#include "shadow/partition/faces.h"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// The planes that decide whether a point belongs to the partition of one side face. The light direction is parallel to
/// each of these planes.
struct FaceSelector {
    Face face = Face::Top;
    /// Normals of the two planes through the eye that separate the face's partition from its neighbours. A point p
    /// belongs to the partition only if dot(first, p) >= 0 and dot(second, p) >= 0. The `first` of a neighbour is the
    /// negative `second` of this face. If there is no neighbour, the normal is 0, and the test passes for all points.
    glm::dvec3 first{0};
    glm::dvec3 second{0};
    /// The test for the near face, if the near face has its own maps: p belongs to the near face if dot(edge, p) <
    /// edgeOffset * n_i, where n_i is the near depth of the slice that contains p.
    glm::dvec3 edge{0};
    double edgeOffset = 0;

    bool operator==(const FaceSelector&) const = default;
};

/// The rule that assigns a point in camera space to a partition, and thus to a shadow map. The shaders repeat
/// `partitionIndex` exactly.
struct PartitionSelector {
    // slice i has depths splits[i] <= z < splits[i + 1]; the first and last slice have no outer limit
    std::vector<double> splits;
    std::vector<FaceSelector> faces; // in cyclic order; empty: each partition is a whole slice
    bool ownNear = false;            // true: the near face of each slice has its own map

    std::size_t facesPerSlice() const { return faces.empty() ? 1 : faces.size() + (ownNear ? 1 : 0); }

    std::size_t partitionCount() const { return (splits.size() - 1) * facesPerSlice(); }

    bool operator==(const PartitionSelector&) const = default;
};

/// The faces of a slice that have their own maps.
enum class FaceMaps : std::uint8_t {
    None,         // one map covers a whole slice
    Sides,        // the side faces, whose maps also cover the near square
    SidesAndNear, // the side faces and the near square
};

/// Min sine of the angle between light and face for which a map with even rows works in single precision.
inline constexpr double kGrazing = 1e-3;

/// Returns the rule that assigns points to partitions, for the depths `splits` and the faces that have maps. If the
/// sine of a face's angle to the light is below `grazing`, the neighbouring faces cover this face. For the near square,
/// this limit is kGrazing. Each point therefore has a partition.
PartitionSelector partitionSelector(
    const ViewFrustum& frustum,
    const glm::dvec3& towardsLight,
    std::vector<double> splits,
    FaceMaps faceMaps,
    double grazing = kGrazing);

/// Returns the index of the partition (and thus the shadow map) that contains `p`: slice * facesPerSlice + face. The
/// splits determine the slice. The face is the first face whose two tests pass; the last side face needs no test. The
/// near face has the last index, and its test comes last.
std::size_t partitionIndex(const PartitionSelector& selector, const glm::dvec3& p);

/// A visible slab: the box of all visible surfaces between two depths.
struct VisibleSlab {
    DepthSpan depths;
    Box box; // world axes, relative to the eye
};

/// The part of the view that one shadow map covers (a partition), in camera space: a closed convex polyhedron.
struct Region {
    std::size_t slice = 0;
    Face face = Face::Whole;
    ViewFrustum frustum; // the slice, in which shadow aliasing has an upper bound
    ViewFrustum covered; // the slice; the first and last slice are extended to receivers outside the frustum
    /// The vertices within the slice, followed by the vertices of the extended part (kind WithoutBound).
    std::vector<FitVertex> vertices;
    ConvexVolume volume; // planes of the covered region; each touches a vertex
};

/// Returns the region of partition `index`, numbered as by partitionIndex. `shown` contains the view depths of all
/// receivers. If some of these depths are outside the frustum, the first and the last slice are extended to them.
Region partitionRegion(
    const ViewFrustum& frustum,
    const PartitionSelector& selector,
    std::size_t index,
    const std::optional<DepthSpan>& shown = std::nullopt);

/// Returns points whose convex hull contains the part of `region` inside the visible slabs `seen` (boxes of visible
/// surfaces). `basis` gives the axes of camera space. Returns an empty list if this part is empty.
std::vector<glm::dvec3> seenCorners(const Region& region, std::span<const VisibleSlab> seen, const CameraBasis& basis);

} // namespace gnomon::shadow
