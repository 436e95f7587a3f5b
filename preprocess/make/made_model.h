// The interface of procedural test models. A model is a sequence of blocks that can be computed in parallel and written
// in order, in bounded memory.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::make {

/// The corners of a triangle, as vertex indices of the whole model. They are counter-clockwise, seen from outside.
using MadeTriangle = std::array<std::uint64_t, 3>;

/// Receives the vertices and the triangles of one block of a model, both in order.
class MeshSink {
public:
    MeshSink() = default;
    virtual ~MeshSink() = default;
    MeshSink(const MeshSink&) = delete;
    MeshSink& operator=(const MeshSink&) = delete;
    MeshSink(MeshSink&&) = delete;
    MeshSink& operator=(MeshSink&&) = delete;

    virtual void addVertices(std::span<const glm::vec3> positions) = 0;
    virtual void addTriangles(std::span<const MadeTriangle> triangles) = 0;
};

/// The numbers of vertices and triangles of a block or of a whole model.
struct MeshSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;

    MeshSize& operator+=(const MeshSize& other) {
        vertices += other.vertices;
        triangles += other.triangles;
        return *this;
    }

    auto operator<=>(const MeshSize&) const = default;
};

/// A procedural model that is computed block by block. Each block depends only on the model's parameters. The output is
/// therefore identical for any order of the blocks and any number of threads.
class MadeModel {
public:
    MadeModel() = default;
    virtual ~MadeModel() = default;
    MadeModel(const MadeModel&) = delete;
    MadeModel& operator=(const MadeModel&) = delete;
    MadeModel(MadeModel&&) = delete;
    MadeModel& operator=(MadeModel&&) = delete;

    virtual std::size_t blockCount() const = 0;

    /// Returns the numbers of vertices and triangles of a block. The function must be fast, because the file layout
    /// needs all sizes before the first block is computed.
    virtual MeshSize blockSize(std::size_t block) const = 0;

    /// Writes exactly `blockSize(block)` vertices and triangles to `sink`. `firstVertex` is the number of vertices in
    /// all earlier blocks.
    virtual void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const = 0;
};

/// Returns the total numbers of vertices and triangles of all blocks of `model`.
MeshSize modelSize(const MadeModel& model);

} // namespace gnomon::make
