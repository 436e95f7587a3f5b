// A procedural model as a sequence of blocks, so that it can be written in order, in parallel and in bounded memory.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::make {

/// The corners of a triangle as indices of vertices of the whole model, counter-clockwise seen from outside.
using MadeTriangle = std::array<std::uint64_t, 3>;

/// Where a block puts its vertices and triangles, both in order.
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

/// How much a block (or a model) holds.
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

/// A model that can be made block by block. Blocks are pure functions of the model: any order, any thread, same bytes.
class MadeModel {
public:
    MadeModel() = default;
    virtual ~MadeModel() = default;
    MadeModel(const MadeModel&) = delete;
    MadeModel& operator=(const MadeModel&) = delete;
    MadeModel(MadeModel&&) = delete;
    MadeModel& operator=(MadeModel&&) = delete;

    virtual std::size_t blockCount() const = 0;

    /// Cheap: the file's layout is computed from this before anything is made.
    virtual MeshSize blockSize(std::size_t block) const = 0;

    /// Puts exactly `blockSize(block)` into `sink`. `firstVertex` is the sum of the vertices of the blocks before.
    virtual void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const = 0;
};

/// The sum over all blocks.
MeshSize modelSize(const MadeModel& model);

} // namespace gnomon::make
