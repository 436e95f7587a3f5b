#include "preprocess/build/page_layout.h"

#include "core/check.h"
#include "hierarchy/cluster_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::preprocess {

namespace {

using hierarchy::kNone;
using hierarchy::Page;

constexpr std::uint32_t kPagesAtOnce = 64;

std::uint64_t decodedBytes(const Level& level, const LevelGroup& group) {
    std::uint64_t bytes = sizeof(hierarchy::Group);
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        bytes += sizeof(hierarchy::Cluster) + level.clusters[c].vertexCount * sizeof(Vertex) +
                 level.clusters[c].triangleCount * sizeof(hierarchy::Triangle);
    return bytes;
}

/// Appends the cluster's triangles, its vertices numbered in the order of their first use.
void addGeometry(const Mesh& mesh, const Level& level, const LevelCluster& cluster, Page& page) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers; // vertex, first corner; then vertex, number
    const std::uint32_t end = cluster.firstTriangle + cluster.triangleCount;
    for (std::uint32_t t = cluster.firstTriangle; t < end; ++t)
        for (const std::uint32_t v : level.triangles[t])
            numbers.emplace_back(v, static_cast<std::uint32_t>(numbers.size()));
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(
        std::unique(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
        numbers.end());
    GNOMON_CHECK_OP(numbers.size(), ==, cluster.vertexCount);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> byUse; // first corner, place in numbers
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
        byUse.emplace_back(numbers[i].second, i);
    std::sort(byUse.begin(), byUse.end());
    for (std::uint32_t number = 0; number < byUse.size(); ++number) {
        auto& entry = numbers[byUse[number].second];
        page.vertices.push_back(mesh.vertices[entry.first]);
        entry.second = number;
    }
    for (std::uint32_t t = cluster.firstTriangle; t < end; ++t) {
        hierarchy::Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found = std::lower_bound(
                numbers.begin(),
                numbers.end(),
                std::pair(level.triangles[t][i], std::uint32_t{0}),
                [](const auto& a, const auto& b) { return a.first < b.first; });
            triangle[i] = static_cast<std::uint8_t>(found->second);
        }
        page.triangles.push_back(triangle);
    }
}

} // namespace

PageLayout::PageLayout(const std::vector<Level>& levels) : places_(levels.size()) {
    for (std::size_t number = levels.size(); number-- > 0;) {
        const Level& level = levels[number];
        places_[number].resize(level.groups.size());
        std::uint64_t bytes = hierarchy::kPageTargetBytes; // full, so that the level begins a page
        for (std::uint32_t g = 0; g < level.groups.size(); ++g) {
            const std::uint64_t own = decodedBytes(level, level.groups[g]);
            if (bytes + own > hierarchy::kPageTargetBytes) {
                pages_.push_back({static_cast<std::uint32_t>(number), g, 0});
                bytes = 0;
            }
            bytes += own;
            places_[number][g] = {pageCount() - 1, pages_.back().groupCount++};
        }
    }
}

Page PageLayout::makePage(const Mesh& mesh, const std::vector<Level>& levels, std::uint32_t id) const {
    const PageSpan& span = pages_[id];
    const Level& level = levels[span.level];
    Page page;
    page.level = span.level;
    std::vector<std::uint32_t> refinements; // groups of the level below, in the order of the page
    for (std::uint32_t g = span.firstGroup; g < span.firstGroup + span.groupCount; ++g) {
        const LevelGroup& source = level.groups[g];
        page.groups.push_back(
            {static_cast<std::uint32_t>(page.clusters.size()),
             source.clusterCount,
             source.box,
             source.bounds,
             source.error});
        for (std::uint32_t c = source.firstCluster; c < source.firstCluster + source.clusterCount; ++c) {
            const LevelCluster& from = level.clusters[c];
            hierarchy::Cluster cluster;
            cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
            cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
            cluster.vertexCount = from.vertexCount;
            cluster.triangleCount = from.triangleCount;
            cluster.box = from.box;
            if (from.refinement != kNone) {
                const auto known = std::find(refinements.begin(), refinements.end(), from.refinement);
                cluster.refinement = static_cast<std::uint32_t>(known - refinements.begin());
                if (known == refinements.end()) {
                    const LevelGroup& finer = levels[span.level - 1].groups[from.refinement];
                    refinements.push_back(from.refinement);
                    page.refinements.push_back({place(span.level - 1, from.refinement), finer.bounds, finer.error});
                }
            }
            page.clusters.push_back(cluster);
            addGeometry(mesh, level, from, page);
        }
    }
    return page;
}

std::uint32_t writePages(
    const Mesh& mesh, const std::vector<Level>& levels, hierarchy::ModelWriter& writer, Progress& progress) {
    const PageLayout layout(levels);
    progress.stage("write", "pages", layout.pageCount());
    std::vector<hierarchy::EncodedPage> encoded(kPagesAtOnce);
    for (std::uint32_t begin = 0; begin < layout.pageCount(); begin += kPagesAtOnce) {
        const std::uint32_t end = std::min(begin + kPagesAtOnce, layout.pageCount());
        tbb::parallel_for(begin, end, [&](std::uint32_t id) {
            Page page = layout.makePage(mesh, levels, id);
            hierarchy::orderForCoding(page);
            encoded[id - begin] = hierarchy::encodePage(page);
        });
        for (std::uint32_t id = begin; id < end; ++id)
            writer.append(encoded[id - begin]);
        progress.advance(end - begin);
    }
    return layout.pageCount();
}

} // namespace gnomon::preprocess
