// Buffers that collect vertices and triangles into blocks and pass full blocks to a callback, the sink of a MeshSource.
#pragma once

#include "preprocess/read/mesh_source.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::read {

/// The number of vertices or triangles in a full block. The data of a block then fit into the level-2 cache.
constexpr std::size_t kBlockRows = 16384;

/// The max number of corners of a polygon. A file with a longer polygon is treated as damaged, because its corner list
/// would exceed the bound on memory.
constexpr std::uint64_t kMaxPolygonCorners = std::uint64_t{1} << 20U;

/// Returns `normal` if it is finite. Otherwise returns the zero vector, which means "no normal".
inline glm::vec3 finiteOrZero(const glm::vec3& normal) {
    return std::isfinite(normal.x + normal.y + normal.z) ? normal : glm::vec3(0);
}

/// Collects vertices into blocks and passes each full block to a callback, the sink.
class VertexBuffer {
public:
    /// Memory for the attributes of appended vertices, one span per attribute. The caller fills it. The spans of
    /// attributes that the input does not have are empty.
    struct Rows {
        std::span<glm::dvec3> positions;
        std::span<glm::vec3> normals;
        std::span<std::uint32_t> colors;
        std::span<double> fields; // scalar properties: fieldCount values per vertex
    };

    /// Says which attributes the vertices have in addition to their positions.
    struct Attributes {
        bool hasNormals = false;
        bool hasColors = false;
        std::size_t fieldCount = 0;
    };

    /// Creates a buffer that passes blocks of vertices to the callback `sink`. The first vertex has the index `first`.
    VertexBuffer(const VertexSink& sink, const Attributes& attributes, std::uint64_t first = 0);

    /// Returns the number of vertices that still fit into the current block, which is at least 1.
    std::size_t room() const { return kBlockRows - size_; }

    /// Appends memory for `count` vertices (at most room()). The caller fills the memory and then calls flushIfFull.
    Rows append(std::size_t count);

    /// Passes the current block to the sink if it is full. The caller must have filled all appended vertices before.
    void flushIfFull() {
        if (size_ == kBlockRows) flush();
    }

    /// Adds `count` to the number of normals in the current block that are infinite or NaN.
    void countBadNormals(std::uint64_t count) { badNormals_ += count; }

    /// Passes the vertices of the current block to the sink, even if the block is not full.
    void flush();

private:
    const VertexSink& sink_;
    std::vector<glm::dvec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<std::uint32_t> colors_;
    std::vector<double> fields_;
    std::size_t fieldCount_;
    std::uint64_t first_;
    std::uint64_t badNormals_ = 0;
    std::size_t size_ = 0;
};

/// Collects triangles into blocks and passes each full block to a callback, the sink. Polygons are split into
/// triangles. Faces with fewer than three corners are only counted.
class TriangleBuffer {
public:
    /// Creates a buffer that passes blocks of triangles to the callback `sink`. The first triangle has the index
    /// `first` in the source.
    explicit TriangleBuffer(const TriangleSink& sink, std::uint64_t first = 0);

    void add(const TriangleCorners& corners) {
        triangles_[size_++] = corners;
        if (size_ >= kBlockRows) flush();
    }

    /// Adds a face with any number of corners, given as vertex indices.
    void addPolygon(std::span<const std::uint64_t> corners);

    /// Returns the unused part of the current block. A caller can write triangles there and then call `commit`.
    std::span<TriangleCorners> room() { return std::span(triangles_).subspan(size_); }

    /// Appends the first `count` triangles that the caller has written into the memory of room().
    void commit(std::size_t count) {
        size_ += count;
        if (size_ >= kBlockRows) flush();
    }

    /// Passes the triangles of the current block to the sink, even if the block is not full.
    void flush();

    /// Returns the index in the source of the next triangle to be added.
    std::uint64_t count() const { return first_ + size_; }

private:
    const TriangleSink& sink_;
    std::vector<TriangleCorners> triangles_;
    std::vector<PolygonRun> polygons_;
    std::uint64_t notAPolygon_ = 0;
    std::uint64_t first_;
    std::size_t size_ = 0;
};

} // namespace gnomon::read
