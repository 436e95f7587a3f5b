// Rasterisation of clusters to depth maps and visibility buffers on the CPU: the input, the targets and the Rasterizer.
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

/// A cluster to draw. It points to arrays of the caller.
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

/// The geometry that a front-to-back pass skipped.
struct OcclusionCounts {
    // clusters whose box overlaps the viewport, but is hidden; their vertices were not read
    std::uint64_t clustersHidden = 0;
    std::uint64_t trianglesHidden = 0; // triangles of the hidden clusters
    std::uint64_t trianglesSetUp = 0;  // only in visibility passes: triangles whose edge functions were computed
    bool operator==(const OcclusionCounts&) const = default;
};

/// The cost of a front-to-back depth pass, in counts.
struct NearestDepths {
    std::uint64_t fragments = 0;
    OcclusionCounts hidden;
};

/// A rectangle of pixels, without its upper ends x1 and y1.
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

/// The projection of a pass from grid positions to the pixels of the target. Clip space is as in OpenGL with depth 0 to
/// w: x and y are in [-w, w], and the depth is z / w.
struct View {
    glm::ivec3 eyeCell{0};     // subtracted from each position; differences must fit an int32
    glm::mat4 clipFromCell{1}; // matrix from these differences to clip space
    PixelBox viewport;         // pixels of the target; the first row is the lowest, pixel centres are at half-integers
    /// y / w of the rows of a logarithmic map, strictly increasing. If empty, the rows are evenly spaced over the
    /// viewport.
    std::span<const float> rowPositions{};
};

/// Returns true if the caller wants at least one pixel of a box of the target.
using BoxFilter = std::function<bool(const PixelBox&)>;

/// The target of a depth pass, for example a shadow map: one float per pixel.
struct DepthTarget {
    float* depths = nullptr; // row by row
    int width = 0;
    int height = 0;
    BoxFilter isWanted{}; // tiles without a wanted pixel are not drawn; empty: all pixels are wanted
};

/// The target of a visibility pass: one word per pixel for its nearest triangle, or 0. The target can contain only some
/// of the image's rows. Other rows are not drawn.
struct VisibilityTarget {
    std::uint64_t* words = nullptr; // row by row
    int width = 0;
    int height = 0;       // number of rows in the target
    BoxFilter isWanted{}; // as in DepthTarget
    int firstRow = 0;     // the image row that is the first row of the target
};

/// Returns the word of a visibility buffer. Its upper half is the depth, and its lower half is the complement of the
/// triangle id. The largest word belongs to the nearest triangle. If depths are equal, the smaller id has the larger
/// word.
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

/// Draws passes, and reuses its memory from pass to pass. Both sides of each triangle are drawn. Positions are snapped
/// to 1/256 pixel, and edge tests are exact. If a pixel centre is on an edge, it belongs to exactly one of the edge's
/// triangles (top-left rule with left and lowest edges inside). A closed mesh therefore has no holes, and no pixel is
/// covered twice. The result does not depend on the number of threads, the instruction set or the order of clusters.
/// Passes run in the caller's TBB arena, one at a time.
class Rasterizer {
public:
    Rasterizer();
    ~Rasterizer();
    Rasterizer(const Rasterizer&) = delete;
    Rasterizer& operator=(const Rasterizer&) = delete;
    Rasterizer(Rasterizer&&) noexcept;
    Rasterizer& operator=(Rasterizer&&) noexcept;

    /// Draws a depth pass: the smallest depth of each pixel of the viewport, or 1 if no triangle covers the pixel.
    /// Depth is not clipped but clamped to [0, 1] per pixel (GL_DEPTH_CLAMP). Casters before and behind the depth range
    /// therefore still cast shadows. Pixels outside the viewport do not change. Returns the number of fragments: the
    /// covered pixels of the viewport, summed over triangles.
    ///
    /// In a logarithmic map, y is snapped to at most 1/256 of the gaps between the surrounding rows. For gaps below
    /// 2^-27 of the largest y, this is 1/16.
    std::uint64_t drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target);

    /// Draws the same depths as `drawDepth`, bit-identical, but skips hidden clusters. It draws each tile from front to
    /// back. drawVisible describes `boxes` and the counts. A cluster whose box extends beyond depths 0 to 1 is always
    /// drawn. Fragments are counted only for drawn triangles.
    NearestDepths drawNearestDepth(
        std::span<const Cluster> clusters, std::span<const CellBox> boxes, const View& view, const DepthTarget& target);

    /// Draws a visibility pass: the nearest triangle of each pixel of the viewport. Depth is reversed (1 at the near
    /// plane, 0 at the far end) and clipped at 0 and 1. Pixels outside the viewport do not change. When all words of a
    /// part of the viewport are complete, the thread that drew the part calls `onTile`. Other threads may still draw at
    /// this time.
    void drawVisibility(
        std::span<const Cluster> clusters,
        const View& view,
        const VisibilityTarget& target,
        const TileVisitor& onTile = {});

    /// Draws the same words as `drawVisibility`, bit-identical, but skips hidden geometry. It draws each tile from
    /// front to back. `boxes` contains the box of each cluster. The pass tests these boxes against the farthest drawn
    /// depths (Greene, Kass, Miller 1993). In clusters that are not hidden, it tests each triangle against the pixels
    /// in its bounding box. The skipped geometry does not depend on the number of threads or the instruction set.
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
