#include "preprocess/verify/locked_edges.h"

#include "core/error.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>

namespace gnomon::preprocess {

using namespace hierarchy;

namespace {

/// A use of an edge or a vertex by a group of the level under work.
struct Use {
    std::uint64_t what = 0;
    std::uint32_t group = 0;
    auto operator<=>(const Use&) const = default;
};

struct Lock {
    std::uint64_t edge = 0;
    EdgeLock lock;
};

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
}

/// Calls `take(a, b)` with the positions' numbers at both ends of each edge of each triangle of `cluster`. Edges
/// without length are passed over.
template <class OfVertex, class Take>
void forEachEdge(const Page& page, const Cluster& cluster, const OfVertex& ofVertex, const Take& take) {
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const Triangle& triangle = page.triangles[cluster.firstTriangle + t];
        const std::array<std::uint32_t, 3> ends = {
            ofVertex(cluster.firstVertex + triangle[0]),
            ofVertex(cluster.firstVertex + triangle[1]),
            ofVertex(cluster.firstVertex + triangle[2])};
        for (std::size_t k = 0; k < 3; ++k)
            if (ends[k] != ends[(k + 1) % 3]) take(ends[k], ends[(k + 1) % 3]);
    }
}

/// Calls `take(run)` for each run of entries of the same thing that belongs to more than one group.
template <class Take>
void forEachShared(std::vector<Use>& uses, const Take& take) {
    tbb::parallel_sort(uses.begin(), uses.end());
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].what == uses[begin].what)
            ++end;
        if (uses[begin].group != uses[end - 1].group) take(std::span<const Use>(uses).subspan(begin, end - begin));
    }
}

} // namespace

LockedEdges::LockedEdges(const LoadedModel& model) {
    numberPositions(model);
    findLocks(model);
    findIncidences(model);
}

void LockedEdges::numberPositions(const LoadedModel& model) {
    struct Place {
        GridPoint position;
        std::uint32_t vertex = 0;
        auto operator<=>(const Place&) const = default;
    };

    std::vector<Place> places;
    std::uint64_t vertices = 0;
    for (const Page& page : model.pages) {
        firstVertex_.push_back(static_cast<std::uint32_t>(vertices));
        vertices += page.vertices.size();
    }
    if (vertices > kNone) throw Error("the model has too many vertices to look for cracks");
    places.reserve(vertices);
    for (const Page& page : model.pages)
        for (const Vertex& vertex : page.vertices)
            places.push_back({vertex.position, static_cast<std::uint32_t>(places.size())});
    tbb::parallel_sort(places.begin(), places.end());
    positionOf_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i == 0 || places[i].position != places[i - 1].position) positions_.push_back(places[i].position);
        positionOf_[places[i].vertex] = static_cast<std::uint32_t>(positions_.size() - 1);
    }
}

void LockedEdges::findLocks(const LoadedModel& model) {
    std::vector<Lock> found;
    std::vector<bool> isShared(positions_.size());
    for (std::uint32_t level = 0; level < model.summary.levels.size(); ++level) {
        std::vector<Use> uses;
        const auto forEachCluster = [&](const auto& use) {
            for (std::size_t p = 0; p < model.pages.size(); ++p) {
                const Page& page = model.pages[p];
                if (page.level != level) continue;
                for (std::uint32_t g = 0; g < page.groups.size(); ++g)
                    for (std::uint32_t c = 0; c < page.groups[g].clusterCount; ++c)
                        use(p, page.clusters[page.groups[g].firstCluster + c], model.firstGroup[p] + g);
            }
        };
        forEachCluster([&](std::size_t p, const Cluster& cluster, std::uint32_t group) {
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
                uses.push_back({positionOf_[firstVertex_[p] + cluster.firstVertex + v], group});
        });
        isShared.assign(isShared.size(), false);
        forEachShared(uses, [&](std::span<const Use> vertex) { isShared[vertex[0].what] = true; });
        uses.clear();
        forEachCluster([&](std::size_t p, const Cluster& cluster, std::uint32_t group) {
            forEachEdge(
                model.pages[p],
                cluster,
                [&](std::uint32_t v) { return positionOf_[firstVertex_[p] + v]; },
                [&](std::uint32_t a, std::uint32_t b) {
                    if (isShared[a] && isShared[b]) uses.push_back({edgeKey(a, b), group});
                });
        });
        forEachShared(uses, [&](std::span<const Use> edge) {
            found.push_back({edge[0].what, {level, static_cast<std::uint32_t>(edge.size())}});
        });
    }
    // Stable, so that the locks of an edge stay in the order of their levels.
    std::stable_sort(found.begin(), found.end(), [](const Lock& a, const Lock& b) { return a.edge < b.edge; });
    for (const Lock& lock : found) {
        if (edges_.empty() || edges_.back() != lock.edge) {
            edges_.push_back(lock.edge);
            firstLock_.push_back(static_cast<std::uint32_t>(locks_.size()));
        }
        locks_.push_back(lock.lock);
    }
    firstLock_.push_back(static_cast<std::uint32_t>(locks_.size()));
    firstEdge_.assign(positions_.size() + 1, 0);
    for (const std::uint64_t edge : edges_)
        ++firstEdge_[(edge >> 32U) + 1];
    for (std::size_t i = 1; i < firstEdge_.size(); ++i)
        firstEdge_[i] += firstEdge_[i - 1];
}

std::uint32_t LockedEdges::find(std::uint64_t edge) const {
    const std::size_t end = edge >> 32U;
    for (std::uint32_t i = firstEdge_[end]; i < firstEdge_[end + 1]; ++i)
        if (edges_[i] == edge) return i;
    return kNone;
}

void LockedEdges::findIncidences(const LoadedModel& model) {
    std::vector<std::vector<std::uint32_t>> byPage(model.pages.size());
    std::vector<std::uint32_t> counts(model.firstCluster.back());
    tbb::parallel_for(std::size_t{0}, model.pages.size(), [&](std::size_t p) {
        for (std::uint32_t c = 0; c < model.pages[p].clusters.size(); ++c) {
            const std::size_t before = byPage[p].size();
            forEachEdge(
                model.pages[p],
                model.pages[p].clusters[c],
                [&](std::uint32_t v) { return positionOf_[firstVertex_[p] + v]; },
                [&](std::uint32_t a, std::uint32_t b) {
                    const std::uint32_t edge = find(edgeKey(a, b));
                    if (edge != kNone) byPage[p].push_back(edge);
                });
            counts[model.firstCluster[p] + c] = static_cast<std::uint32_t>(byPage[p].size() - before);
        }
    });
    firstIncidence_.reserve(counts.size() + 1);
    firstIncidence_.push_back(0);
    for (const std::uint32_t count : counts)
        firstIncidence_.push_back(firstIncidence_.back() + count);
    incidences_.reserve(firstIncidence_.back());
    for (const auto& edges : byPage)
        incidences_.insert(incidences_.end(), edges.begin(), edges.end());
}

} // namespace gnomon::preprocess
