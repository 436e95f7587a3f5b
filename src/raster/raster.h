// Depth and visibility rasterisation of clusters on the CPU: input, targets and the Rasterizer.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace gnomon::raster {

/// The vertex indices of a triangle within its cluster.
using Triangle = std::array<std::uint8_t, 3>;

/// The max size of a cluster. Vertex indices are bytes, and so is the index of a triangle in its cluster.
constexpr std::uint32_t kMaxClusterVertices = 256;
constexpr std::uint32_t kMaxClusterTriangles = 256;

/// A cluster to draw. It refers to arrays of the caller.
struct Cluster {
    const std::uint32_t* positions = nullptr; // grid coordinates x, y, z of the first vertex
    std::uint32_t positionStride = 12;        // bytes from one vertex to the next, a multiple of 4
    std::uint32_t vertexCount = 0;
    std::span<const Triangle> triangles;
    std::uint32_t firstTriangleId = 0; // triangle i has the id firstTriangleId + i
};

/// A closed box of grid positions.
struct CellBox {
    std::array<std::uint32_t, 3> min{};
    std::array<std::uint32_t, 3> max{};
};

/// The skipped geometry of a front-to-back pass.
struct OcclusionCounts {
    std::uint64_t clustersHidden = 0;  // boxes that touch the viewport; their vertices were not read
    std::uint64_t trianglesHidden = 0; // triangles of the hidden clusters
    std::uint64_t trianglesSetUp = 0;  // visibility passes only: triangles with computed edge functions
    bool operator==(const OcclusionCounts&) const = default;
};

/// The cost of a front-to-back depth pass.
struct NearestDepths {
    std::uint64_t fragments = 0;
    OcclusionCounts hidden;
};

/// A half-open rectangle of whole pixels.
struct PixelBox {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }

    int width() const { return x1 - x0; }

    int height() const { return y1 - y0; }

    bool operator==(const PixelBox&) const = default;
};

/// The projection of a pass from the grid to the target. Clip space is that of OpenGL with depth 0 to w: x and y from
/// -w to w, depth z / w.
struct View {
    glm::ivec3 eyeCell{0};     // subtracted from each position first; differences must fit an int32
    glm::mat4 clipFromCell{1}; // applied to the difference
    PixelBox viewport;         // pixels of the target; the first row is the lowest, pixel centres are at half-integers
    /// y / w of the sample rows, strictly increasing; empty: even rows across the viewport.
    std::span<const float> rowPositions{};
};

/// Returns true if a pixel of a box of the target is wanted.
using BoxFilter = std::function<bool(const PixelBox&)>;

/// The target of a depth pass, for example a shadow map: one float per pixel.
struct DepthTarget {
    float* depths = nullptr; // row by row
    int width = 0;
    int height = 0;
    BoxFilter isWanted{}; // tiles without a wanted pixel are not changed; empty: all are wanted
};

/// The target of a visibility pass: one word per pixel for the nearest triangle, or 0. The target may hold only some
/// rows of the image; other rows are not drawn.
struct VisibilityTarget {
    std::uint64_t* words = nullptr; // row by row
    int width = 0;
    int height = 0;       // number of rows in the target
    BoxFilter isWanted{}; // the same as in DepthTarget
    int firstRow = 0;     // index in the image of the target's first row
};

/// Returns the word of a visibility buffer: depth in the upper half, complement of the triangle id in the lower half.
/// The largest word is the nearest triangle. With equal depths, the smaller id wins.
constexpr std::uint64_t visibilityWord(float depth, std::uint32_t triangleId) {
    return (std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32U) | static_cast<std::uint32_t>(~triangleId);
}

constexpr float visibleDepth(std::uint64_t word) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(word >> 32U));
}

constexpr std::uint32_t visibleTriangle(std::uint64_t word) {
    return ~static_cast<std::uint32_t>(word);
}

/// Max side of viewports and targets, in pixels.
constexpr int kMaxTargetSide = 16384;

using TileVisitor = std::function<void(const PixelBox&)>;

/// Draws passes and reuses its memory from pass to pass. It draws both sides of each triangle. Positions are snapped to
/// 1/256 pixel, and edge tests are exact. A pixel centre on an edge belongs to exactly one side (left and lowest edges
/// are inside). A closed mesh therefore has no holes, and no pixel is covered twice. The result does not depend on the
/// number of threads, the instruction set or the order of clusters. Passes run in the caller's TBB arena, one at a
/// time.
class Rasterizer {
public:
    Rasterizer();
    ~Rasterizer();
    Rasterizer(const Rasterizer&) = delete;
    Rasterizer& operator=(const Rasterizer&) = delete;
    Rasterizer(Rasterizer&&) noexcept;
    Rasterizer& operator=(Rasterizer&&) noexcept;

    /// Draws the smallest depth of each pixel of the viewport, or 1 without a triangle. Depth is not clipped but
    /// clamped to [0, 1] per pixel (GL_DEPTH_CLAMP). Casters before and behind the range therefore still cast shadows.
    /// Pixels outside the viewport are not changed. Returns the number of fragments: the covered pixels of the
    /// viewport, summed over triangles. With uneven rows, y is snapped to at most 1/256 of the surrounding gaps between
    /// rows (1/16 below 2^-27 of the largest y).
    std::uint64_t drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

    /// Draws the same depths as `drawDepth`, to the last bit, but skips hidden clusters. It draws each tile from front
    /// to back; drawVisible describes `boxes` and the counts. Clusters whose boxes leave depths 0 to 1 are always
    /// drawn. Counts the fragments of drawn triangles only.
    NearestDepths drawNearestDepth(
        std::span<const Cluster> clusters, std::span<const CellBox> boxes, const View& view, const DepthTarget& target);

    /// Draws the nearest triangle of each pixel of the viewport. Depth is reversed (1 at the near plane, 0 at the far
    /// end) and clipped at 0 and 1. Pixels outside the viewport are not changed. Calls `onTile` for each part of the
    /// viewport when its words are complete. The call comes from the drawing thread while other threads still draw.
    void drawVisibility(
        std::span<const Cluster> clusters,
        const View& view,
        const VisibilityTarget& target,
        const TileVisitor& onTile = {});

    /// Draws the same words as `drawVisibility`, to the last bit, but skips hidden geometry. It draws each tile from
    /// front to back. It tests `boxes`, which contain the positions of their clusters, against the farthest drawn
    /// depths (Greene, Kass, Miller 1993). In clusters that are not hidden, it tests each triangle against the pixels
    /// between its extremes. The skipped geometry does not depend on the number of threads or the instruction set.
    OcclusionCounts drawVisible(
        std::span<const Cluster> clusters,
        std::span<const CellBox> boxes,
        const View& view,
        const VisibilityTarget& target);

private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

} // namespace gnomon::raster
