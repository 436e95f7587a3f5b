// Finds the locked edges of each level of detail, and the triangles of clusters at these edges. The surface of a level
// consists of its groups and of the clusters that it defers to a coarser level. An edge is locked if several of these
// groups and deferred clusters share it. A locked edge does not change between this surface and the next coarser
// surface.
#pragma once

#include "preprocess/verify/loaded_model.h"

#include <span>
#include <utility>
#include <vector>

namespace gnomon::verify {

/// Says that an edge is locked at one level, and how many triangles have this edge in the surface of this level.
struct EdgeLock {
    std::uint32_t level = 0;
    std::uint32_t triangles = 0;
};

/// The box that contains all possible grid points.
inline constexpr hierarchy::GridBox kWholeGrid{
    {0, 0, 0}, {hierarchy::kMaxGridCoordinate, hierarchy::kMaxGridCoordinate, hierarchy::kMaxGridCoordinate}};

/// The locked edges of a model in one box of the grid (cell). An edge belongs to the cell that contains its lower end
/// (compared by x, y, z). Edges are defined by positions instead of vertices: each end is the number of a distinct
/// position. All pages whose boxes overlap the cell must be loaded.
class LockedEdges {
public:
    explicit LockedEdges(const LoadedModel& model, const hierarchy::GridBox& cell = kWholeGrid);

    std::size_t count() const { return edges_.size(); }

    /// Returns at which levels the edge with the number `edge` is locked, in level order, with its number of triangles
    /// there.
    std::span<const EdgeLock> locks(std::uint32_t edge) const {
        return std::span(locks_).subspan(firstLock_[edge], firstLock_[edge + 1] - firstLock_[edge]);
    }

    /// Returns the levels whose surface contains the cluster with the number `cluster`, as a set of bits. Clusters are
    /// numbered across pages.
    std::uint64_t levelsOf(std::uint32_t cluster) const { return levelsOf_[cluster]; }

    /// Returns the edges of all triangles of the cluster with the number `cluster`. An edge is repeated for each of its
    /// triangles. Clusters are numbered across pages.
    std::span<const std::uint32_t> edgesOf(std::uint32_t cluster) const {
        return std::span(incidences_)
            .subspan(firstIncidence_[cluster], firstIncidence_[cluster + 1] - firstIncidence_[cluster]);
    }

    /// Returns the position of the first or the second end of the edge with the number `edge`.
    hierarchy::GridPoint end(std::uint32_t edge, bool second) const {
        return positions_[second ? static_cast<std::uint32_t>(edges_[edge]) : edges_[edge] >> 32U];
    }

private:
    void numberPositions(const LoadedModel& model);
    bool isOurs(std::uint32_t lowerEnd) const;
    using FoundLock = std::pair<std::uint64_t, EdgeLock>;

    void findLevels(const LoadedModel& model);
    void findLocks(const LoadedModel& model);
    void findLocksOfLevel(const LoadedModel& model, std::uint32_t level, std::vector<FoundLock>& found) const;
    void findIncidences(const LoadedModel& model);
    std::uint32_t find(std::uint64_t edge) const;

    hierarchy::GridBox cell_;
    std::vector<std::uint64_t> levelsOf_;    // levels per cluster, as bits
    std::vector<std::uint32_t> firstVertex_; // number of the first vertex per page
    std::vector<std::uint32_t> positionOf_;  // number of the position per vertex, across pages
    std::vector<hierarchy::GridPoint> positions_;
    std::vector<std::uint64_t> edges_;     // lower end << 32 | higher end, in ascending order
    std::vector<std::uint32_t> firstEdge_; // index of the first edge per lower end
    std::vector<std::uint32_t> firstLock_;
    std::vector<EdgeLock> locks_;
    std::vector<std::uint64_t> firstIncidence_;
    std::vector<std::uint32_t> incidences_;
};

} // namespace gnomon::verify
