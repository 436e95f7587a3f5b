// Selects the uniform cuts of a model for the levels of a tileset. Each cut has about four times the triangles of the
// previous cut.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"

#include <cstdint>
#include <vector>

namespace gnomon::exporter {

/// A cluster, with the range of error limits for which a uniform cut contains it.
struct TileCluster {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    std::uint32_t triangles = 0;
    hierarchy::GridBox box;
    // The smallest error limit (world units) of a cut that contains the cluster. It is below 0 if no finer cluster
    // exists.
    double drawnFrom = 0;
    double drawnUntil = 0; // from this error limit (world units) on, a coarser cluster replaces it

    bool isInCut(double limit) const { return limit >= drawnFrom && limit < drawnUntil; }

    /// Returns true if no finer clusters can replace this cluster.
    bool isFinest() const { return drawnFrom < 0; }
};

/// Returns how many bytes the functions clustersOf and limitsOf need.
std::uint64_t surveyBytes(const hierarchy::ModelFile& file);

/// Returns all clusters of a model in the order of its pages. Each uniform cut (hierarchy/cut_rule.h) is a subset of
/// them.
std::vector<TileCluster> clustersOf(const hierarchy::ModelFile& file, Progress& progress);

/// Returns the error limits (world units) of the cuts for the levels of a tileset, coarsest first, without repeated
/// values. The first limit is the smallest limit whose cut has at most `triangles` triangles. Each next cut has at most
/// four times as many triangles as the previous cut. The last limit is 0, the finest cut.
std::vector<double> limitsOf(const std::vector<TileCluster>& clusters, std::uint64_t triangles);

} // namespace gnomon::exporter
