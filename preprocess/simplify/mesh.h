// A welded mesh on the grid: what all phases after the binning work on.
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

/// Three indices of vertices or positions.
using Triangle = std::array<std::uint32_t, 3>;

/// A mesh whose topology is welded by position; vertices (corners) of one position differ in normal or colour. It may
/// be a part of a model: a chunk, or the clusters of a round's node.
struct Mesh {
    Grid grid;
    std::vector<Vertex> vertices;          // all different
    std::vector<std::uint32_t> positionOf; // vertex -> position id, dense from 0
    std::uint32_t positionCount = 0;
    std::vector<std::uint8_t> isBorder; // per position: triangles outside this mesh may share it, so it must stay
    std::vector<Triangle> triangles;    // vertex indices; the three positions of a triangle differ
    hierarchy::PageFields fields;       // of the vertices, which are equal only where these are

    bool hasFields() const { return fields.layout.count() > 0; }

    std::uint32_t fieldsOf(std::uint32_t vertex) const { return hasFields() ? fields.words[vertex] : 0; }
};

} // namespace gnomon::simplify
