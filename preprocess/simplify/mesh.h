// A welded mesh on the grid: what all phases after the binning work on.
#pragma once

#include "hierarchy/model.h"

#include <algorithm>
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

/// Chunks as a closed range of ids.
struct ChunkSpan {
    std::uint16_t first = 0;
    std::uint16_t last = 0;

    void add(const ChunkSpan& other) {
        first = std::min(first, other.first);
        last = std::max(last, other.last);
    }

    bool operator==(const ChunkSpan&) const = default;
};

/// A mesh whose topology is welded by position; vertices (corners) of one position differ in normal or colour. It may
/// be a part of a model: one chunk, or several that were merged.
struct Mesh {
    Grid grid;
    std::vector<Vertex> vertices;          // all different
    std::vector<std::uint32_t> positionOf; // vertex -> position id, dense from 0
    std::uint32_t positionCount = 0;
    std::vector<ChunkSpan> sharers;  // per position: all chunks with triangles there are among these
    ChunkSpan chunks;                // of which this is made
    std::vector<Triangle> triangles; // vertex indices; the three positions of a triangle differ

    /// Whether triangles outside this mesh may share the position: it must stay where it is.
    bool isBorder(std::uint32_t position) const {
        return sharers[position].first < chunks.first || sharers[position].last > chunks.last;
    }
};

} // namespace gnomon::simplify
