// Collects vertices and triangles into the blocks that sinks of a MeshSource receive.
#pragma once

#include "preprocess/read/mesh_source.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::read {

/// Rows or triangles of a full block: small enough for the second-level cache.
constexpr std::size_t kBlockRows = 16384;

/// More corners than any real polygon; a longer list is a damaged file, and would break the bound on memory.
constexpr std::uint64_t kMostPolygonCorners = std::uint64_t{1} << 20U;

/// Returns `normal`, or zero, which stands for none, if it is not finite.
inline glm::vec3 finiteOrZero(const glm::vec3& normal) {
    return std::isfinite(normal.x + normal.y + normal.z) ? normal : glm::vec3(0);
}

/// Collects vertices.
class VertexBuffer {
public:
    /// Places to fill for rows that were appended; what the input has not is empty.
    struct Rows {
        std::span<glm::dvec3> positions;
        std::span<glm::vec3> normals;
        std::span<std::uint32_t> colors;
        std::span<double> fields; // fieldCount a vertex
    };

    /// What vertices have besides positions.
    struct Attributes {
        bool hasNormals = false;
        bool hasColors = false;
        std::size_t fieldCount = 0;
    };

    /// Of vertices from `first` on.
    VertexBuffer(const VertexSink& sink, const Attributes& attributes, std::uint64_t first = 0);

    /// Rows that fit before the next flush, at least 1.
    std::size_t room() const { return kBlockRows - size_; }

    /// Appends `count` (at most room()) rows for the caller to fill before the next call. The filled block is handed on
    /// by the call after it.
    Rows append(std::size_t count);

    /// Hands a full block on; call after the rows of `append` are filled.
    void flushIfFull() {
        if (size_ == kBlockRows) flush();
    }

    /// Counts normals of the appended rows that are not finite.
    void countBadNormals(std::uint64_t count) { badNormals_ += count; }

    /// Hands on what is left.
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

/// Collects triangles, polygons and faces that are none.
class TriangleBuffer {
public:
    /// Of triangles from `first` on.
    explicit TriangleBuffer(const TriangleSink& sink, std::uint64_t first = 0);

    void add(const TriangleCorners& corners) {
        triangles_[size_++] = corners;
        if (size_ >= kBlockRows) flush();
    }

    /// A face of any number of corners, given as its vertex indices.
    void addPolygon(std::span<const std::uint64_t> corners);

    /// The free places of the block, for callers that write triangles themselves and then `commit` as many.
    std::span<TriangleCorners> room() { return std::span(triangles_).subspan(size_); }

    void commit(std::size_t count) {
        size_ += count;
        if (size_ >= kBlockRows) flush();
    }

    /// Hands on what is left.
    void flush();

    /// Triangles so far.
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
