// The vertices that a chunk has and uses, found by the index that they have in the source.
#pragma once

#include "preprocess/chunk/chunk_streams.h"

namespace gnomon::chunk {

/// Those that lie in the chunk come first, then those of other chunks.
class IndexedVertices {
public:
    /// The first `ownCount` by ascending index, the others in any order; no index twice.
    IndexedVertices(std::vector<ChunkVertex> vertices, std::size_t ownCount);

    std::size_t size() const { return vertices_.size(); }

    /// How many lie in the chunk.
    std::size_t ownCount() const { return ownCount_; }

    const ChunkVertex& operator[](std::uint32_t vertex) const { return vertices_[vertex]; }

    /// Gives the vertices up, in the order that they have here.
    std::vector<ChunkVertex> take() && {
        runs_ = {};
        firstRun_ = {};
        return std::move(vertices_);
    }

    /// Its number here; a check fails for a vertex that the chunk has not.
    std::uint32_t find(std::uint64_t sourceIndex) const;

    simplify::Triangle find(const read::TriangleCorners& corners) const {
        return {find(corners[0]), find(corners[1]), find(corners[2])};
    }

private:
    /// Vertices that follow each other both in the source and here. Scans have few runs, and long ones.
    struct Run {
        std::uint64_t index = 0;
        std::uint32_t vertex = 0;
        std::uint32_t count = 0;
    };

    /// Calls `begin(index, vertex)` where a run begins and `extend()` for each of its vertices, by ascending index.
    template <class Begin, class Extend>
    void forEachRun(const std::vector<std::uint32_t>& foreign, const Begin& begin, const Extend& extend) const;

    void findRuns();
    void bucketRuns();

    std::vector<ChunkVertex> vertices_;
    std::size_t ownCount_;
    std::vector<Run> runs_; // by ascending index
    std::uint32_t bucketShift_ = 0;
    std::vector<std::uint32_t> firstRun_; // that begins in each bucket of 2^bucketShift_ indices, or after it
};

} // namespace gnomon::chunk
