// The convex regions that partitions own, with their vertices and planes, and the rule that says which partition owns a
// point: by selection, never by a mask product.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "core/depth_span.h"
#include "shadow/partition/faces.h"

#include <optional>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// A side face as the selection sees it. All its planes contain the light's direction.
struct FaceSelector {
    Face face = Face::Top;
    glm::dvec3 first{0};   // the face owns p only if dot(first, p) >= 0 and dot(second, p) >= 0: planes through the
    glm::dvec3 second{0};  // eye that part it from its neighbours, whose first is -second; 0 where there is none,
                           // which every p passes
    glm::dvec3 edge{0};    // with an own near map: p belongs to the near face where dot(edge, p) < edgeOffset * n_i,
    double edgeOffset = 0; // n_i the near depth of p's slice

    bool operator==(const FaceSelector&) const = default;
};

/// Which partition a point in camera space belongs to. Shaders repeat `ownerOf` word for word.
struct PartitionSelector {
    std::vector<double> splits;      // slice i owns splits[i] <= z < splits[i + 1], the ends unbounded
    std::vector<FaceSelector> faces; // in cyclic order; empty: a partition is a whole slice
    bool ownNear = false;            // the near face has partitions of its own

    std::size_t facesPerSlice() const { return faces.empty() ? 1 : faces.size() + (ownNear ? 1 : 0); }

    std::size_t partitionCount() const { return (splits.size() - 1) * facesPerSlice(); }

    bool operator==(const PartitionSelector&) const = default;
};

/// Which faces of a slice have maps of their own.
enum class FaceMaps : std::uint8_t {
    None,         // a map shows a whole slice
    Sides,        // the side faces, which reach the near square
    SidesAndNear, // the side faces and the near square
};

/// The sine of the light's angle to a face below which its map is too thin for single precision.
inline constexpr double kGrazing = 1e-3;

/// The selector of `splits` and of the faces that bear maps. Faces whose angle to the light has a sine below
/// `grazing`, and near squares below kGrazing, are left to their neighbours, so nothing is left out.
PartitionSelector partitionSelector(
    const ViewFrustum& frustum,
    const glm::dvec3& towardsLight,
    std::vector<double> splits,
    FaceMaps faceMaps,
    double grazing = kGrazing);

/// The partition that owns `p`: slice * facesPerSlice + face, the near face last. The slice by splits, then the first
/// face whose two tests hold, the last face needing none, then the near face's test.
std::size_t ownerOf(const PartitionSelector& selector, const glm::dvec3& p);

/// What an image shows between two depths.
struct SeenPart {
    DepthSpan depths;
    Box box; // world axes, relative to the eye
};

/// The region of one partition, in camera space: closed, convex, bounded by what its map covers of its slice.
struct Region {
    std::size_t slice = 0;
    Face face = Face::Whole;
    ViewFrustum frustum;             // of the slice: what its map promises an aliasing for
    ViewFrustum covered;             // the same, or more where an end slice owns what is shown beyond it
    std::vector<FitVertex> vertices; // of the slice's part; then, Unpromised, those of what is covered beyond it
    ConvexVolume volume;             // of what is covered; every plane touches a vertex
};

/// The region of partition `index`, in the numbering of ownerOf. The end slices cover `shown` too, the view depths of
/// all that the image shows, where that goes past the frustum.
Region partitionRegion(
    const ViewFrustum& frustum,
    const PartitionSelector& selector,
    std::size_t index,
    const std::optional<DepthSpan>& shown = std::nullopt);

/// Points whose convex hull holds all of `seen` that lies in `region`; `basis` is that of camera space. None if nothing
/// does.
std::vector<glm::dvec3> seenCorners(const Region& region, std::span<const SeenPart> seen, const CameraBasis& basis);

} // namespace gnomon::shadow
