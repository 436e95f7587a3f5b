// Made clusters for the rasteriser's tests and benchmark.
#pragma once

#include "core/random.h"
#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

/// Clusters that own their arrays.
class Scene {
public:
    /// Adds one cluster of at most 256 vertices; its triangles get the next names.
    void add(std::vector<std::array<std::uint32_t, 3>> positions, std::vector<Triangle> triangles);

    /// Valid until the next `add`.
    std::vector<Cluster> clusters() const;

    std::uint32_t triangleCount() const { return triangleCount_; }

private:
    struct Stored {
        std::vector<std::array<std::uint32_t, 3>> positions;
        std::vector<Triangle> triangles;
        std::uint32_t firstTriangleId = 0;
    };

    std::vector<Stored> stored_;
    std::uint32_t triangleCount_ = 0;
};

/// Grid positions of scenes are around this, one pixel of a `flatView` is kFlatPixel cells.
constexpr std::uint32_t kSceneCenter = 1U << 30U;
constexpr std::uint32_t kFlatPixel = 1024;

/// Looks along z at `viewport` without perspective: position kSceneCenter + (x, y) kFlatPixel is the pixel corner (x,
/// y) of the viewport; depth 0 to 1 is kSceneCenter to kSceneCenter + 2^20.
View flatView(const PixelBox& viewport);

/// A bumpy sheet of `columns` x `rows` quads of `spacing` pixels over the viewport's lower left, two triangles each,
/// vertices moved at random, in clusters of 128 triangles.
Scene sheet(int columns, int rows, double spacing, std::uint64_t seed);

/// Unconnected triangles around kSceneCenter, from less than a pixel to larger than the screen, with some of no area.
Scene soup(int triangles, std::uint64_t seed);

/// Small heaps of triangles, and walls of one large triangle that hide some of them.
Scene crowd(std::uint64_t seed);

/// The boxes of the clusters' vertices.
std::vector<CellBox> boxesOf(const std::vector<Cluster>& clusters);

/// A random perspective (depth reversed, near and far both inside the scene) from amid the triangles of a soup.
View insideView(const PixelBox& viewport, std::uint64_t seed);

} // namespace gnomon::raster
