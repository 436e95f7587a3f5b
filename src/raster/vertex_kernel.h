// The vertex stage for all vertices of a cluster, with one vertex per SIMD lane.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Max number of SIMD lanes on all instruction sets. Arrays of snapped vertices are read and written in whole SIMD
/// vectors.
constexpr std::uint32_t kMaxLanes = 16;

constexpr std::uint32_t paddedVertexCount(std::uint32_t count) {
    return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

/// The vertices of a cluster after snapping to subpixels, as arrays of paddedVertexCount elements.
struct SnappedArrays {
    std::int32_t* x = nullptr; // in 1/256 pixel of the target
    std::int32_t* y = nullptr; // in 1/256 pixel of the target; in a logarithmic map: the bits of y / w
    float* z = nullptr;
    std::uint32_t* rests = nullptr; // snapping remainders as in SnappedVertex: x in the lower half, y in the upper half
};

constexpr std::uint32_t packedRests(const SnappedVertex& vertex) {
    return static_cast<std::uint16_t>(vertex.restX) | std::uint32_t{static_cast<std::uint16_t>(vertex.restY)} << 16U;
}

/// Max width and height of a compact cluster, in pixels. A compact cluster stores x and y of a vertex in the two halves
/// of one word, in 1/256 pixel. The origin is one pixel to the left of and below the cluster's box. A triangle corner
/// then needs one load instead of two.
constexpr int kMaxCompactPixels = 254;

enum class ClusterPlace {
    Outside, // the cluster is outside one frustum plane and not drawn
    Inside,  // all vertices are valid
    Cut      // some triangles need clipping, so the arrays are not valid
};

struct VertexStage {
    ClusterPlace place = ClusterPlace::Outside;
    PixelBox box;           // pixel centres in the bounding box of the snapped vertices; only if place is Inside
    float maxZ = 0;         // max z of the vertices; only if place is Inside
    bool isCompact = false; // true: x is in the lower half of snapped.x, y in the upper half; snapped.y is not written
};

/// Projects the vertices of a cluster, snaps them to subpixels, and stores them in `snapped`.
VertexStage snapVertices(const Projection& projection, const Cluster& cluster, const SnappedArrays& snapped);

} // namespace gnomon::raster
