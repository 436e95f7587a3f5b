// The software rasteriser: draws clusters of triangles to depth maps and visibility buffers on the CPU.
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

/// The max size of a cluster. The index of a vertex or a triangle in its cluster fits into one byte.
constexpr std::uint32_t kMaxClusterVertices = 256;
constexpr std::uint32_t kMaxClusterTriangles = 256;

/// A cluster of triangles to draw. The arrays belong to the caller.
struct Cluster {
    const std::uint32_t* positions = nullptr; // grid coordinates x, y, z of the first vertex
    std::uint32_t positionStride = 12;        // bytes from one vertex to the next, a multiple of 4
    std::uint32_t vertexCount = 0;
    std::span<const Triangle> triangles;
    std::uint32_t firstTriangleId = 0; // triangle i has the id firstTriangleId + i
};

/// A box of grid positions, both ends included.
struct CellBox {
    std::array<std::uint32_t, 3> min{};
    std::array<std::uint32_t, 3> max{};
};

/// The numbers of clusters and triangles that occlusion culling skipped in a pass.
struct OcclusionCounts {
    // Clusters whose box overlaps the viewport but is hidden. Their vertices were not read.
    std::uint64_t clustersHidden = 0;
    std::uint64_t trianglesHidden = 0; // triangles of the hidden clusters
    std::uint64_t trianglesSetUp = 0;  // only in visibility passes: triangles whose edge functions were computed
    bool operator==(const OcclusionCounts&) const = default;
};

/// The counts of a front-to-back depth pass.
struct NearestDepths {
    std::uint64_t fragments = 0;
    OcclusionCounts hidden;
};

/// A rectangle of pixels. The upper ends x1 and y1 are not included.
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

/// The projection of a pass from grid positions to pixels of the target. Clip space is the same as in OpenGL with depth
/// 0 to w: x and y are in [-w, w], and the depth is z / w.
struct View {
    glm::ivec3 eyeCell{0};     // subtracted from each position; differences must fit an int32
    glm::mat4 clipFromCell{1}; // matrix from these differences to clip space
    PixelBox viewport;         // pixels of the target; the first row is the lowest, pixel centres are at half-integers
    /// For a logarithmic map: y / w of each row, strictly increasing. If empty, the rows are evenly spaced over the
    /// viewport.
    std::span<const float> rowPositions{};
};

/// Returns true if the caller needs at least one pixel of a box of the target.
using BoxFilter = std::function<bool(const PixelBox&)>;

/// The target of a depth pass, for example a shadow map, with one float per pixel.
struct DepthTarget {
    float* depths = nullptr; // row by row
    int width = 0;
    int height = 0;
    BoxFilter isWanted{}; // tiles without a wanted pixel are not drawn; empty: all pixels are wanted
};

/// The visibility buffer that a pass draws into: one word per pixel for its nearest triangle, or 0. The target can
/// consist of only some rows of the image. All other rows are not drawn.
struct VisibilityTarget {
    std::uint64_t* words = nullptr; // row by row
    int width = 0;
    int height = 0;       // number of rows in the target
    BoxFilter isWanted{}; // as in DepthTarget
    int firstRow = 0;     // the image row that is the first row of the target
};

/// Packs a depth and a triangle id into one word of a visibility buffer. The upper half is the depth, and the lower
/// half is the complement of the id. The nearest triangle has the largest word. Of two triangles with equal depth, the
/// smaller id has the larger word.
constexpr std::uint64_t visibilityWord(float depth, std::uint32_t triangleId) {
    return (std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32U) | static_cast<std::uint32_t>(~triangleId);
}

constexpr float visibleDepth(std::uint64_t word) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(word >> 32U));
}

constexpr std::uint32_t visibleTriangle(std::uint64_t word) {
    return ~static_cast<std::uint32_t>(word);
}

/// Max width and height of viewports and targets, in pixels.
constexpr int kMaxTargetSide = 16384;

using TileVisitor = std::function<void(const PixelBox&)>;

/// Draws clusters of triangles to depth maps and visibility buffers, and reuses its memory. Both sides of each triangle
/// are drawn. Positions are snapped to 1/256 pixel, and edge tests are exact. A pixel centre on an edge belongs to
/// exactly one triangle of the edge (top-left rule with left and lowest edges inside). A closed mesh therefore has no
/// holes, and no pixel is covered twice. The result does not depend on the number of threads, the instruction set or
/// the order of clusters. Passes run in the caller's TBB arena, one at a time.
class Rasterizer {
public:
    Rasterizer();
    ~Rasterizer();
    Rasterizer(const Rasterizer&) = delete;
    Rasterizer& operator=(const Rasterizer&) = delete;
    Rasterizer(Rasterizer&&) noexcept;
    Rasterizer& operator=(Rasterizer&&) noexcept;

    /// Draws the smallest depth of each pixel of the viewport, or 1 if no triangle covers the pixel. Pixels outside the
    /// viewport do not change. Depth is not clipped but clamped to [0, 1] per pixel (GL_DEPTH_CLAMP). Casters before
    /// and behind the depth range therefore still cast shadows. Returns the number of covered pixels of the viewport,
    /// summed over triangles.
    ///
    /// In a logarithmic map, y is snapped to at most 1/256 of the gaps between the surrounding rows. For gaps below
    /// 2^-27 of the largest y, this is 1/16.
    std::uint64_t drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

    /// Draws the same depths as `drawDepth`, bit-identical, but from front to back and without hidden clusters. `boxes`
    /// contains the bounding box of each cluster. A cluster whose box extends beyond depths 0 to 1 is always drawn. The
    /// number of fragments includes only drawn triangles.
    NearestDepths drawNearestDepth(
        std::span<const Cluster> clusters, std::span<const CellBox> boxes, const View& view, const DepthTarget& target);

    /// Draws the nearest triangle of each pixel of the viewport into a visibility buffer. Depth is reversed (1 at the
    /// near plane, 0 at the far end) and clipped at 0 and 1. Pixels outside the viewport do not change. The drawing
    /// thread calls `onTile` for each complete part of the viewport, while other threads may still draw.
    void drawVisibility(
        std::span<const Cluster> clusters,
        const View& view,
        const VisibilityTarget& target,
        const TileVisitor& onTile = {});

    /// Draws the same visibility buffer as `drawVisibility`, bit-identical, but from front to back and without hidden
    /// geometry. `boxes` contains the bounding box of each cluster, which is tested against the farthest drawn depths
    /// (Greene, Kass, Miller 1993). In visible clusters, each triangle is tested against the pixels in its bounding
    /// box. The skipped geometry does not depend on the number of threads or the instruction set.
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
