// The input for drawing one tile of a depth map or an image: the pixels, the memory layout and the clusters.
#pragma once

#include "raster/vertex_kernel.h"

#include <array>
#include <cstdint>

namespace gnomon::raster {

/// Max width and height of a tile, in pixels.
constexpr int kTileSide = 256;

/// Number of pixels from one row of a tile to the next in memory. A tile has a margin at its right and upper edge,
/// because SIMD stores can extend beyond the tile.
constexpr int kTileStride = kTileSide + 16;
constexpr int kTileRows = kTileSide + 4;
constexpr std::size_t kTilePixels = std::size_t{kTileStride} * kTileRows;

/// A cluster whose vertices are snapped to subpixels. Its triangles need no clipping.
struct SnappedCluster {
    SnappedArrays vertices;
    bool isCompact = false; // true: vertices.x stores both coordinates of a vertex, see `compacted`
    std::span<const Triangle> triangles;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangleId = 0;
    // The ids of the triangles. If null, triangle i has the id firstTriangleId + i.
    const std::uint32_t* triangleIds = nullptr;
    PixelBox box;   // all pixels that the cluster can cover
    float maxZ = 0; // max z of its vertices
};

/// A set of triangles of a cluster, one bit per triangle.
using TriangleBits = std::array<std::uint64_t, kMaxClusterTriangles / 64>;

/// A tile and the clusters that overlap the tile.
struct TileWork {
    PixelBox box;
    std::span<const SnappedCluster> clusters; // all clusters of the pass
    std::span<const std::uint32_t> indices;   // the clusters of this tile
};

} // namespace gnomon::raster
