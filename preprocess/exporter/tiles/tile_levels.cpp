#include "preprocess/exporter/tiles/tile_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace gnomon::exporter {

using namespace hierarchy;

namespace {

/// The number of triangles that a uniform cut gains or loses when its error limit passes `error`.
struct Change {
    double error = 0;
    std::int64_t triangles = 0;
};

std::uint64_t clusterCount(const ModelFile& file) {
    std::uint64_t count = 0;
    for (const PageInfo& info : file.pages())
        count += info.clusterCount;
    return count;
}

std::vector<TileCluster> clustersOfPage(const ModelFile& file, std::uint32_t p) {
    std::vector<TileCluster> clusters;
    const Page page = file.readPage(p);
    for (const Group& group : page.groups)
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            const Cluster& cluster = page.clusters[c];
            const double from = cluster.refinement == kNone ? -1 : page.refinements[cluster.refinement].drawnError();
            clusters.push_back({p, c, cluster.triangleCount, cluster.box, from, group.drawnError()});
        }
    return clusters;
}

} // namespace

std::uint64_t surveyBytes(const ModelFile& file) {
    // The bytes for decoded pages and for the clusters of several pages.
    constexpr std::uint64_t kOther = std::uint64_t{16} << 20U;
    return kOther + clusterCount(file) * (sizeof(TileCluster) + 4 * sizeof(Change));
}

std::vector<TileCluster> clustersOf(const ModelFile& file, Progress& progress) {
    constexpr std::size_t kPagesAtOnce = 256;
    const std::size_t pageCount = file.pages().size();
    std::vector<TileCluster> clusters;
    clusters.reserve(clusterCount(file));
    std::vector<std::vector<TileCluster>> some(std::min(kPagesAtOnce, pageCount));
    progress.stage("survey", "pages", pageCount);
    for (std::size_t first = 0; first < pageCount; first += some.size()) {
        const std::size_t count = std::min(some.size(), pageCount - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            some[i] = clustersOfPage(file, static_cast<std::uint32_t>(first + i));
            progress.advance(1);
        });
        for (std::size_t i = 0; i < count; ++i)
            clusters.insert(clusters.end(), some[i].begin(), some[i].end());
    }
    return clusters;
}

std::vector<double> limitsOf(const std::vector<TileCluster>& clusters, std::uint64_t triangles) {
    std::vector<Change> changes;
    changes.reserve(2 * clusters.size());
    for (const TileCluster& cluster : clusters) {
        changes.push_back({std::max(cluster.drawnFrom, 0.0), cluster.triangles});
        changes.push_back({cluster.drawnUntil, -std::int64_t{cluster.triangles}});
    }
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.error < b.error; });
    std::vector<Change> cuts; // error limits with the number of triangles of their cuts
    std::int64_t sum = 0;
    for (const Change& change : changes) {
        sum += change.triangles;
        if (!(change.error < std::numeric_limits<double>::infinity())) break;
        if (cuts.empty() || cuts.back().error != change.error) cuts.push_back({change.error, 0});
        cuts.back().triangles = sum;
    }
    std::vector<double> limits;
    for (auto maxTriangles = static_cast<std::int64_t>(triangles);; maxTriangles *= 4) {
        const auto found = std::find_if(
            cuts.begin(), cuts.end(), [maxTriangles](const Change& cut) { return cut.triangles <= maxTriangles; });
        const double limit = found == cuts.end() ? cuts.back().error : found->error;
        if (limit <= 0) break;
        if (limits.empty() || limit < limits.back()) limits.push_back(limit);
    }
    limits.push_back(0);
    return limits;
}

} // namespace gnomon::exporter
