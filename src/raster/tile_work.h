// A tile of a map or of a picture: its size, the layout of its memory, and the clusters that touch it.
#pragma once

#include "raster/vertex_kernel.h"

#include <array>
#include <cstdint>

namespace gnomon::raster {

/// Tiles are squares of at most this many pixels.
constexpr int kTileSide = 256;

/// A row of a tile's memory. What vectors write past the tile's right and upper edge lands in the margin.
constexpr int kTileStride = kTileSide + 16;
constexpr int kTileRows = kTileSide + 4;
constexpr std::size_t kTilePixels = std::size_t{kTileStride} * kTileRows;

/// A cluster whose vertices are snapped and that needs no cutting any more.
struct SnappedCluster {
    SnappedArrays vertices;
    bool isCompact = false; // vertices.x holds both coordinates, see `compacted`
    std::span<const Triangle> triangles;
    std::uint32_t vertexCount = 0;
    std::uint32_t firstTriangleId = 0;
    const std::uint32_t* triangleIds = nullptr; // instead of firstTriangleId + i where given
    PixelBox box;                               // holds every pixel that it can cover
    float mostZ = 0;                            // of its vertices
};

/// Triangles of a cluster by their places, a bit each.
using TriangleBits = std::array<std::uint64_t, kMaxClusterTriangles / 64>;

/// A tile and the clusters that touch it.
struct TileWork {
    PixelBox box;
    std::span<const SnappedCluster> clusters; // of the whole pass
    std::span<const std::uint32_t> indices;   // those of this tile
};

} // namespace gnomon::raster
