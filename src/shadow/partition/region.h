// The convex regions of the partitions, with vertices and planes, and the rule that assigns each point to one
// partition. The rule selects a partition directly; it does not multiply masks.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "core/depth_span.h"
#include "shadow/partition/faces.h"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// A side face as the selection uses it. The light direction lies in each of its planes.
struct FaceSelector {
    Face face = Face::Top;
    /// Normals of the two planes through the eye that separate the face from its neighbours. The face owns p only if
    /// dot(first, p) >= 0 and dot(second, p) >= 0. The `first` of a neighbour is the negated `second` of this face. The
    /// normal is 0 where there is no neighbour, and each p then passes.
    glm::dvec3 first{0};
    glm::dvec3 second{0};
    /// The test of the near face, if it has its own maps: p belongs to the near face if dot(edge, p) < edgeOffset *
    /// n_i, where n_i is the near depth of p's slice.
    glm::dvec3 edge{0};
    double edgeOffset = 0;

    bool operator==(const FaceSelector&) const = default;
};

/// The rule that assigns a point in camera space to a partition. Shaders repeat `partitionIndex` exactly.
struct PartitionSelector {
    std::vector<double> splits;      // slice i owns splits[i] <= z < splits[i + 1]; end slices have no outer limit
    std::vector<FaceSelector> faces; // in cyclic order; empty: each partition is a whole slice
    bool ownNear = false;            // true: the near face has its own partitions

    std::size_t facesPerSlice() const { return faces.empty() ? 1 : faces.size() + (ownNear ? 1 : 0); }

    std::size_t partitionCount() const { return (splits.size() - 1) * facesPerSlice(); }

    bool operator==(const PartitionSelector&) const = default;
};

/// The faces of a slice that have their own maps.
enum class FaceMaps : std::uint8_t {
    None,         // one map covers a whole slice
    Sides,        // the side faces, extended over the near square
    SidesAndNear, // the side faces and the near square
};

/// The smallest sine of the angle between light and face at which a map with even rows works in single precision.
inline constexpr double kGrazing = 1e-3;

/// Returns the selector for `splits` and for the faces that have maps. Neighbours take over a face if the sine of its
/// angle to the light is below `grazing`, and a near square if it is below kGrazing. Each point therefore has a
/// partition.
PartitionSelector partitionSelector(
    const ViewFrustum& frustum,
    const glm::dvec3& towardsLight,
    std::vector<double> splits,
    FaceMaps faceMaps,
    double grazing = kGrazing);

/// Returns the index of the partition that owns `p`: slice * facesPerSlice + face. The near face is the last face. The
/// splits select the slice. Then the first face whose two tests pass is selected; the last face needs no test. The test
/// of the near face comes last.
std::size_t partitionIndex(const PartitionSelector& selector, const glm::dvec3& p);

/// A visible slab: the box of all visible surfaces between two depths.
struct VisibleSlab {
    DepthSpan depths;
    Box box; // world axes, relative to the eye
};

/// The region of one partition, in camera space: a closed convex polyhedron.
struct Region {
    std::size_t slice = 0;
    Face face = Face::Whole;
    ViewFrustum frustum; // the slice with the map's aliasing bound
    ViewFrustum covered; // the slice, extended if it is an end slice and receivers lie outside the frustum
    /// First the vertices within the slice; then, of kind WithoutBound, the vertices of the extended part.
    std::vector<FitVertex> vertices;
    ConvexVolume volume; // planes of the covered region; each touches a vertex
};

/// Returns the region of partition `index`, in the numbering of partitionIndex. The first and the last slice are
/// extended to `shown`, the view depths of all receivers, where these lie outside the frustum.
Region partitionRegion(
    const ViewFrustum& frustum,
    const PartitionSelector& selector,
    std::size_t index,
    const std::optional<DepthSpan>& shown = std::nullopt);

/// Returns points whose convex hull contains the intersection of the visible slabs `seen` with `region`. `basis` gives
/// the axes of camera space. Returns an empty list if the intersection is empty.
std::vector<glm::dvec3> seenCorners(const Region& region, std::span<const VisibleSlab> seen, const CameraBasis& basis);

} // namespace gnomon::shadow
