#include "preprocess/exporter/tiles/tile_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <map>

namespace gnomon::exporter {

using namespace hierarchy;

namespace {

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

std::vector<TileCluster> clustersOf(const ModelFile& file, Progress& progress) {
    constexpr std::size_t kPagesAtOnce = 256;
    const std::size_t pageCount = file.pages().size();
    std::vector<TileCluster> clusters;
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
    std::map<double, std::int64_t> change; // of the number of triangles, where the limit passes an error
    for (const TileCluster& cluster : clusters) {
        change[std::max(cluster.drawnFrom, 0.0)] += cluster.triangles;
        change[cluster.drawnUntil] -= cluster.triangles;
    }
    std::vector<std::pair<double, std::int64_t>> cuts; // limit, triangles
    std::int64_t sum = 0;
    for (const auto& [error, count] : change) {
        sum += count;
        if (error < std::numeric_limits<double>::infinity()) cuts.emplace_back(error, sum);
    }
    std::vector<double> limits;
    for (auto most = static_cast<std::int64_t>(triangles);; most *= 4) {
        const auto found =
            std::find_if(cuts.begin(), cuts.end(), [most](const auto& cut) { return cut.second <= most; });
        const double limit = found == cuts.end() ? cuts.back().first : found->first;
        if (limit <= 0) break;
        if (limits.empty() || limit < limits.back()) limits.push_back(limit);
    }
    limits.push_back(0);
    return limits;
}

} // namespace gnomon::exporter
