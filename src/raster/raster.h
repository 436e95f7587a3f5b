// Depth and visibility rasterising of clusters on the CPU: what a pass takes and what it leaves.
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

/// Vertex indices within the cluster.
using Triangle = std::array<std::uint8_t, 3>;

/// The largest cluster that a pass takes: indices are bytes, and so is a triangle's place in its cluster.
constexpr std::uint32_t kMaxClusterVertices = 256;
constexpr std::uint32_t kMaxClusterTriangles = 256;

/// A cluster to draw; it borrows its arrays.
struct Cluster {
    const std::uint32_t* positions = nullptr; // grid coordinates x, y, z of the first vertex
    std::uint32_t positionStride = 12;        // bytes from a vertex to the next, a multiple of 4
    std::uint32_t vertexCount = 0;
    std::span<const Triangle> triangles;
    std::uint32_t firstTriangleId = 0; // triangle i is drawn under the name firstTriangleId + i
};

/// A closed box of grid positions.
struct CellBox {
    std::array<std::uint32_t, 3> min{};
    std::array<std::uint32_t, 3> max{};
};

/// What a pass that draws from the front to the back left out.
struct OcclusionCounts {
    std::uint64_t clustersHidden = 0;  // whose boxes touch the viewport, and whose vertices were not looked at
    std::uint64_t trianglesHidden = 0; // of these
    std::uint64_t trianglesSetUp = 0;  // of a visibility pass: given edge functions
    bool operator==(const OcclusionCounts&) const = default;
};

/// What such a pass of depths took.
struct NearestDepths {
    std::uint64_t fragments = 0;
    OcclusionCounts hidden;
};

/// A rectangle of whole pixels, half-open.
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

/// How a pass sees the grid. Clip space is GL's with a depth of 0 to w: x and y from -w to w, depth z / w.
struct View {
    glm::ivec3 eyeCell{0};     // subtracted from each position first; the differences must fit an int32
    glm::mat4 clipFromCell{1}; // of the difference
    PixelBox viewport;         // pixels of the target; its first row is GL's lowest, pixel centres are at halves
    /// Where the rows of the viewport lie, y / w of their samples, strictly increasing; nothing: evenly, as above.
    std::span<const float> rowPositions{};
};

/// Whether any pixel of a part of the target is asked for.
using BoxFilter = std::function<bool(const PixelBox&)>;

/// Shadow maps and other plain depth: one float a pixel.
struct DepthTarget {
    float* depths = nullptr; // row by row
    int width = 0;
    int height = 0;
    BoxFilter isWanted{}; // tiles for which it answers no are left alone; empty: all are wanted
};

/// The nearest triangle of each pixel: one word a pixel, 0 where there is none. The target may hold some rows of the
/// image only; the others are left alone.
struct VisibilityTarget {
    std::uint64_t* words = nullptr; // row by row
    int width = 0;
    int height = 0;       // rows that the target holds
    BoxFilter isWanted{}; // as a DepthTarget's
    int firstRow = 0;     // of the image; the first row that the target holds
};

/// A word of a visibility buffer: depth above, the complement of the name below, so that the largest word is the
/// nearest triangle and the least name wins a tie.
constexpr std::uint64_t visibilityWord(float depth, std::uint32_t triangleId) {
    return (std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32U) | static_cast<std::uint32_t>(~triangleId);
}

constexpr float visibleDepth(std::uint64_t word) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(word >> 32U));
}

constexpr std::uint32_t visibleTriangle(std::uint64_t word) {
    return ~static_cast<std::uint32_t>(word);
}

/// Viewports and targets reach at most this far.
constexpr int kMaxTargetSide = 16384;

using TileVisitor = std::function<void(const PixelBox&)>;

/// Draws passes; keeps its working memory from one to the next. Both sides of a triangle are drawn. Positions are
/// snapped to 1/256 pixel, edges are exact, and a pixel centre on an edge belongs to one of its sides (left and lowest
/// edges are inside), so a mesh has no hole and no pixel covered twice. The result does not depend on the number of
/// threads, on the instruction set, or on the order of the clusters. Runs in the caller's TBB arena; one pass at a
/// time.
class Rasterizer {
public:
    Rasterizer();
    ~Rasterizer();
    Rasterizer(const Rasterizer&) = delete;
    Rasterizer& operator=(const Rasterizer&) = delete;
    Rasterizer(Rasterizer&&) noexcept;
    Rasterizer& operator=(Rasterizer&&) noexcept;

    /// The least depth of each pixel of the viewport, 1 where nothing is drawn. Nothing is cut at depth 0 or 1: depth
    /// is clamped to that range at each pixel (GL_DEPTH_CLAMP), so casters before and behind the range still cast.
    /// Pixels outside the viewport are left alone. Answers how many fragments that took: the pixels of the viewport
    /// that each triangle covers, summed. Where the view's rows lie unevenly, y is snapped to at most 1/256 of the gaps
    /// between rows around it (1/16 below 2^-27 of all y), and all else is as above: an edge is of one of its sides.
    std::uint64_t drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

    /// The same depths as `drawDepth` leaves, to the bit, without looking at what lies behind what is drawn:
    /// each tile from the nearest on, as `drawVisible` does, which see for `boxes` and what comes back. Clusters whose
    /// boxes reach out of depths 0 to 1 are drawn whatever hides them. Counted are fragments of what was drawn.
    NearestDepths drawNearestDepth(
        std::span<const Cluster> clusters, std::span<const CellBox> boxes, const View& view, const DepthTarget& target);

    /// The triangle of largest depth of each pixel of the viewport (depth reversed: 1 at the near plane, 0 at the far
    /// end), cut at depths 0 and 1. Pixels outside the viewport are left alone. `onTile` is told of each part of the
    /// viewport once its words are in the target, from the thread that drew it, while others still draw.
    void drawVisibility(
        std::span<const Cluster> clusters,
        const View& view,
        const VisibilityTarget& target,
        const TileVisitor& onTile = {});

    /// The same words as `drawVisibility` leaves, to the bit, without looking at what lies behind what is seen: draws
    /// each tile from the front to the back, and tests `boxes`, each of which holds the positions of its cluster,
    /// against the farthest depths of what is drawn there (Greene, Kass, Miller 1993); of clusters that are not
    /// hidden, each triangle against the pixels between its extremes. What was left out depends neither on the number
    /// of threads nor on the instruction set.
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
