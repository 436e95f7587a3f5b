// Uniform cuts of a model, each of about four times the triangles of the one before, as lists of clusters.
#pragma once

#include "core/progress.h"
#include "hierarchy/model_file.h"

#include <cstdint>
#include <vector>

namespace gnomon::exporter {

/// A cluster of a cut.
struct TileCluster {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    std::uint32_t triangles = 0;
    hierarchy::GridBox box;
    double drawnFrom = 0;  // the largest limit of a cut that is too fine for it, world units; below 0 for none
    double drawnUntil = 0; // the limit from which on a coarser one stands for it

    bool isInCut(double limit) const { return limit >= drawnFrom && limit < drawnUntil; }

    /// Nothing finer stands for it in any cut.
    bool isFinest() const { return drawnFrom < 0; }
};

/// What `clustersOf` and `limitsOf` take, in bytes.
std::uint64_t surveyBytes(const hierarchy::ModelFile& file);

/// All clusters of a model, page by page: those that a uniform cut of any limit draws (hierarchy/cut_rule.h) among
/// them.
std::vector<TileCluster> clustersOf(const hierarchy::ModelFile& file, Progress& progress);

/// Limits of cuts, coarsest first, in world units: the least for which the cut has at most `triangles`, four times as
/// many, and so on; the last is 0, the finest cut. No two are equal.
std::vector<double> limitsOf(const std::vector<TileCluster>& clusters, std::uint64_t triangles);

} // namespace gnomon::exporter
