// Buffers that collect vertices and triangles into blocks. The sinks of a MeshSource receive these blocks.
#pragma once

#include "preprocess/read/mesh_source.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::read {

/// The number of vertices or triangles of a full block. A block of this size fits into the second-level cache.
constexpr std::size_t kBlockRows = 16384;

/// The max number of corners of a polygon. A file with a longer list is damaged, and the list would exceed the bound on
/// memory.
constexpr std::uint64_t kMaxPolygonCorners = std::uint64_t{1} << 20U;

/// Returns `normal` if it is finite. Otherwise returns the zero vector, which means "no normal".
inline glm::vec3 finiteOrZero(const glm::vec3& normal) {
    return std::isfinite(normal.x + normal.y + normal.z) ? normal : glm::vec3(0);
}

/// Collects vertices and passes them to a sink in blocks.
class VertexBuffer {
public:
    /// The memory of the appended vertices, which the caller fills. Spans of attributes that the input does not have
    /// are empty.
    struct Rows {
        std::span<glm::dvec3> positions;
        std::span<glm::vec3> normals;
        std::span<std::uint32_t> colors;
        std::span<double> fields; // fieldCount values per vertex
    };

    /// The attributes of vertices in addition to their positions.
    struct Attributes {
        bool hasNormals = false;
        bool hasColors = false;
        std::size_t fieldCount = 0;
    };

    /// Creates a buffer that passes vertices to `sink`. The first vertex has the index `first`.
    VertexBuffer(const VertexSink& sink, const Attributes& attributes, std::uint64_t first = 0);

    /// Returns the number of vertices that fit into the current block, at least 1.
    std::size_t room() const { return kBlockRows - size_; }

    /// Appends memory for `count` vertices (at most room()). The caller fills the memory and then calls flushIfFull.
    Rows append(std::size_t count);

    /// Passes the block to the sink if it is full. The caller must have filled all vertices of the last `append`.
    void flushIfFull() {
        if (size_ == kBlockRows) flush();
    }

    /// Adds `count` to the number of normals in the block that are not finite.
    void countBadNormals(std::uint64_t count) { badNormals_ += count; }

    /// Passes the remaining vertices to the sink.
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

/// Collects triangles and polygons, and passes them to a sink in blocks. Counts faces with fewer than three corners.
class TriangleBuffer {
public:
    /// Creates a buffer that passes triangles to `sink`. The first triangle has the source index `first`.
    explicit TriangleBuffer(const TriangleSink& sink, std::uint64_t first = 0);

    void add(const TriangleCorners& corners) {
        triangles_[size_++] = corners;
        if (size_ >= kBlockRows) flush();
    }

    /// Adds a face with any number of corners. `corners` are vertex indices.
    void addPolygon(std::span<const std::uint64_t> corners);

    /// Returns the unused triangles of the block. A caller can write triangles there and then call `commit`.
    std::span<TriangleCorners> room() { return std::span(triangles_).subspan(size_); }

    /// Adds `count` triangles that the caller has written to room().
    void commit(std::size_t count) {
        size_ += count;
        if (size_ >= kBlockRows) flush();
    }

    /// Passes the remaining triangles to the sink.
    void flush();

    /// Returns the source index of the next triangle.
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
