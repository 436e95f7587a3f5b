// The welded source on the grid: what all phases after reading work on.
#pragma once

#include "hierarchy/model.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gnomon::preprocess {

using hierarchy::Grid;
using hierarchy::GridBox;
using hierarchy::GridPoint;
using hierarchy::Vertex;

/// Three indices of vertices or positions.
using Triangle = std::array<std::uint32_t, 3>;

/// A mesh whose topology is welded by position; vertices (corners) of one position differ in normal or colour.
struct Mesh {
    Grid grid;
    Box bounds;                            // of the snapped positions, world space
    std::vector<Vertex> vertices;          // all different
    std::vector<std::uint32_t> positionOf; // vertex -> position id, dense from 0
    std::uint32_t positionCount = 0;
    std::vector<Triangle> triangles; // vertex indices; the three positions of a triangle differ
    std::uint64_t sourceTriangles = 0;
    std::uint64_t sourceVertices = 0;
    std::map<std::string, std::uint64_t> dropped; // reason -> source triangles; all four reasons are there
    bool hasNormals = false;                      // from the source or smoothed
    bool hasColors = false;
};

} // namespace gnomon::preprocess
