// A triangle mesh with welded vertices on an integer grid. All phases of a build after the sorting into chunks use it.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::simplify {

using hierarchy::Grid;
using hierarchy::GridBox;
using hierarchy::GridPoint;
using hierarchy::Vertex;

/// A triangle: three indices of vertices or positions.
using Triangle = std::array<std::uint32_t, 3>;

/// A part of a model as a mesh: one chunk of the source mesh, or the clusters of one octree cell. Its topology depends
/// only on positions. Vertices at the same position differ in normal, colour or fields.
struct Mesh {
    Grid grid;
    std::vector<Vertex> vertices; // no two vertices are equal
    // per vertex: index of its position; position indices start at 0 without gaps
    std::vector<std::uint32_t> positionOf;
    std::uint32_t positionCount = 0;
    std::vector<std::uint8_t> isBorder; // per position: 1 if other meshes may share it; it must then not move
    std::vector<Triangle> triangles;    // vertex indices; the three positions of a triangle differ
    hierarchy::PageFields fields;       // fields of the vertices; equal vertices have equal fields

    bool hasFields() const { return fields.layout.count() > 0; }

    std::uint32_t fieldsOf(std::uint32_t vertex) const { return hasFields() ? fields.words[vertex] : 0; }
};

} // namespace gnomon::simplify
