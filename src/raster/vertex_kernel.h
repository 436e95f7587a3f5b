// The vertex stage for a whole cluster, in vector lanes.
#pragma once

#include "raster/projection.h"

namespace gnomon::raster {

/// Max lanes of a vector. Arrays of snapped vertices are read and written in whole vectors.
constexpr std::uint32_t kMaxLanes = 16;

constexpr std::uint32_t paddedVertexCount(std::uint32_t count) {
    return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

/// The snapped vertices of a cluster: arrays of paddedVertexCount elements.
struct SnappedArrays {
    std::int32_t* x = nullptr; // 1/256 pixel in the target
    std::int32_t* y = nullptr; // with uneven rows: the bits of y / w
    float* z = nullptr;
    std::uint32_t* rests = nullptr; // rests: x in the lower half, y in the upper half, as in SnappedVertex
};

constexpr std::uint32_t packedRests(const SnappedVertex& vertex) {
    return static_cast<std::uint16_t>(vertex.restX) | std::uint32_t{static_cast<std::uint16_t>(vertex.restY)} << 16U;
}

/// Max width and height of a compact cluster, in pixels. A compact cluster stores x and y in the halves of one word, in
/// 1/256 pixel. The origin is one pixel left of and below the cluster's box. A corner then needs one load instead of
/// two.
constexpr int kMaxCompactPixels = 254;

enum class ClusterPlace {
    Outside, // outside one frustum plane: nothing to draw
    Inside,  // each vertex is valid
    Cut      // some triangles need clipping: the arrays are not valid
};

struct VertexStage {
    ClusterPlace place = ClusterPlace::Outside;
    PixelBox box;           // pixel centres between the extremes of the snapped vertices; only if place is Inside
    float maxZ = 0;         // max z of the vertices; only if place is Inside
    bool isCompact = false; // true: x is in the lower half of snapped.x, y in the upper half; snapped.y is not written
};

/// Projects and snaps the vertices of a cluster.
VertexStage snapVertices(const Projection& projection, const Cluster& cluster, const SnappedArrays& snapped);

} // namespace gnomon::raster
