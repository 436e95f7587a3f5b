// The vertices of one chunk, and the vertices of other chunks that it uses. They can be found by their index in the
// source.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

namespace gnomon::chunk {

/// A list of vertices with a lookup by source index. The vertices of the chunk are first, then the vertices of other
/// chunks.
class IndexedVertices {
public:
    /// Creates the list from `vertices`. The first `ownCount` vertices are in the chunk and must have ascending source
    /// indices. The other vertices may have any order. Source indices are unique.
    IndexedVertices(std::vector<ChunkVertex> vertices, std::size_t ownCount);

    std::size_t size() const { return vertices_.size(); }

    /// Returns the number of vertices that are in the chunk itself.
    std::size_t ownCount() const { return ownCount_; }

    const ChunkVertex& operator[](std::uint32_t vertex) const { return vertices_[vertex]; }

    /// Moves the vertices out of the object, in the same order.
    std::vector<ChunkVertex> take() && {
        runs_ = {};
        firstRun_ = {};
        return std::move(vertices_);
    }

    /// Returns the list index of the vertex that has the index `sourceIndex` in the source. A check fails if the list
    /// does not contain the vertex.
    std::uint32_t find(std::uint64_t sourceIndex) const;

    simplify::Triangle find(const read::TriangleCorners& corners) const {
        return {find(corners[0]), find(corners[1]), find(corners[2])};
    }

private:
    /// A run of vertices with consecutive indices both in the source and in this list. The mesh of a 3D scan has few
    /// long runs.
    struct Run {
        std::uint64_t index = 0;
        std::uint32_t vertex = 0;
        std::uint32_t count = 0;
    };

    /// Calls `begin(index, vertex)` for the first vertex of each run of consecutive vertices, and `extend()` for each
    /// vertex of the run. The runs are in ascending order of the source index.
    template <class Begin, class Extend>
    void forEachRun(const std::vector<std::uint32_t>& foreign, const Begin& begin, const Extend& extend) const;

    void findRuns();
    void bucketRuns();

    std::vector<ChunkVertex> vertices_;
    std::size_t ownCount_;
    std::vector<Run> runs_; // by ascending source index
    std::uint32_t bucketShift_ = 0;
    // Per bucket of 2^bucketShift_ source indices: the first run that starts in this bucket or a later one.
    std::vector<std::uint32_t> firstRun_;
};

} // namespace gnomon::chunk
