// The vertex stage for whole clusters, in vector lanes.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Arrays of snapped vertices are read and written in whole vectors of at most this many lanes.
constexpr std::uint32_t kMostLanes = 16;

constexpr std::uint32_t paddedVertexCount(std::uint32_t count) {
    return (count + kMostLanes - 1) / kMostLanes * kMostLanes;
}

/// A cluster's snapped vertices: paddedVertexCount elements each.
struct SnappedArrays {
    std::int32_t* x = nullptr; // 1/256 pixel in the target
    std::int32_t* y = nullptr; // where rows lie unevenly: the bits of y / w
    float* z = nullptr;
    std::uint32_t* rests = nullptr; // what snapping cut off: x in the low half, y in the high half, as SnappedVertex
};

constexpr std::uint32_t packedRests(const SnappedVertex& vertex) {
    return static_cast<std::uint16_t>(vertex.restX) | std::uint32_t{static_cast<std::uint16_t>(vertex.restY)} << 16U;
}

/// Clusters at most this many pixels wide and high are kept compact: x and y in the halves of one word, in 1/256 pixel
/// from one pixel left of and below their box, so that a corner takes one load instead of two.
constexpr int kMostCompactPixels = 254;

enum class ClusterPlace {
    Outside, // outside of one plane of the frustum: nothing to draw
    Inside,  // every vertex may be used as it is
    Cut      // some triangles must be cut: what the arrays hold is of no use
};

struct VertexStage {
    ClusterPlace place = ClusterPlace::Outside;
    PixelBox box;           // pixel centres between the extremes of the snapped vertices; only where place is Inside
    float mostZ = 0;        // of them, likewise
    bool isCompact = false; // x in the low half of snapped.x, y in the high half; snapped.y is not written
};

/// Projects and snaps the vertices of a cluster.
VertexStage snapVertices(const Projection& projection, const Cluster& cluster, const SnappedArrays& snapped);

} // namespace gnomon::raster
