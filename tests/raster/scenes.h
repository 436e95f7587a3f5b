// Generated clusters for the tests and the benchmark of the rasteriser.
#pragma once

#include "core/random.h"
#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

/// Clusters that own their arrays.
class Scene {
public:
    /// Adds a cluster of at most 256 vertices. Its triangles get the next ids.
    void add(std::vector<std::array<std::uint32_t, 3>> positions, std::vector<Triangle> triangles);

    /// Returns the clusters. They are valid until the next `add`.
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

/// The centre of scenes on the grid, and the cells per pixel of a `flatView`.
constexpr std::uint32_t kSceneCenter = 1U << 30U;
constexpr std::uint32_t kFlatPixel = 1024;

/// Returns an orthographic view along z of `viewport`. The position kSceneCenter + (x, y) kFlatPixel is the pixel
/// corner (x, y) of the viewport. Depths from 0 to 1 are kSceneCenter to kSceneCenter + 2^20.
View flatView(const PixelBox& viewport);

/// Returns a bumpy sheet of `columns` x `rows` quads of `spacing` pixels at the viewport's lower left. Each quad has
/// two triangles, and vertices are moved randomly. Clusters have 128 triangles.
Scene sheet(int columns, int rows, double spacing, std::uint64_t seed);

/// Returns unconnected triangles around kSceneCenter, from smaller than a pixel to larger than the screen, some with
/// zero area.
Scene soup(int triangles, std::uint64_t seed);

/// Returns small heaps of triangles, and walls of one large triangle that hide some of them.
Scene crowd(std::uint64_t seed);

/// Returns the bounding boxes of the clusters.
std::vector<CellBox> boxesOf(const std::vector<Cluster>& clusters);

/// Returns a random perspective view from inside a soup of triangles. Depth is reversed, and near and far planes are
/// within the scene.
View insideView(const PixelBox& viewport, std::uint64_t seed);

} // namespace gnomon::raster
