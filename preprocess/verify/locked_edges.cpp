#include "preprocess/verify/locked_edges.h"

#include "core/error.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

/// Records that `owner` uses an edge or a vertex (`what`). The owner is a group of the current level or a cluster that
/// this level defers to a coarser level.
struct Use {
    std::uint64_t what = 0;
    std::uint64_t owner = 0;

    bool operator<(const Use& other) const { return std::tie(what, owner) < std::tie(other.what, other.owner); }
};

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
}

/// Calls `take(a, b)` for each edge of the triangles of `cluster`. `a` and `b` are the position numbers of the edge's
/// ends. Edges of zero length are skipped.
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

/// Calls `take(page, cluster, owner)` for each cluster in the surface of level `level`. The owner is the group of the
/// cluster. If the level defers the cluster to a coarser level, the owner is the cluster itself.
template <class Take>
void forEachCluster(const LoadedModel& model, const LockedEdges& edges, std::uint32_t level, const Take& take) {
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        if (page.level < level) continue;
        for (std::uint32_t g = 0; g < page.groups.size(); ++g)
            for (std::uint32_t i = 0; i < page.groups[g].clusterCount; ++i) {
                const std::uint32_t c = page.groups[g].firstCluster + i;
                if ((edges.levelsOf(model.firstCluster[p] + c) >> level & 1U) == 0) continue;
                const bool isDeferred = page.level > level;
                const std::uint64_t itself = std::uint64_t{model.firstGroup.back()} + model.firstCluster[p] + c;
                take(p, page.clusters[c], isDeferred ? itself : model.firstGroup[p] + g);
            }
    }
}

/// Calls `take(run)` for each edge or vertex that several owners use. `run` contains all of its uses.
template <class Take>
void forEachShared(std::vector<Use>& uses, const Take& take) {
    tbb::parallel_sort(uses.begin(), uses.end());
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].what == uses[begin].what)
            ++end;
        if (uses[begin].owner != uses[end - 1].owner) take(std::span<const Use>(uses).subspan(begin, end - begin));
    }
}

} // namespace

LockedEdges::LockedEdges(const LoadedModel& model, const GridBox& cell) : cell_(cell) {
    numberPositions(model);
    findLevels(model);
    findLocks(model);
    findIncidences(model);
}

void LockedEdges::numberPositions(const LoadedModel& model) {
    struct Place {
        GridPoint position;
        std::uint32_t vertex = 0;

        bool operator<(const Place& other) const {
            return std::tie(position, vertex) < std::tie(other.position, other.vertex);
        }
    };

    std::vector<Place> places;
    std::uint64_t vertices = 0;
    for (const Page& page : model.pages) {
        firstVertex_.push_back(static_cast<std::uint32_t>(vertices));
        vertices += page.vertices.size();
    }
    if (vertices > kNone) throw Error("the model has too many vertices for the search for cracks");
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

bool LockedEdges::isOurs(std::uint32_t lowerEnd) const {
    const GridPoint& p = positions_[lowerEnd];
    return p.x >= cell_.min.x && p.x <= cell_.max.x && p.y >= cell_.min.y && p.y <= cell_.max.y && p.z >= cell_.min.z &&
           p.z <= cell_.max.z;
}

void LockedEdges::findLevels(const LoadedModel& model) {
    levelsOf_.resize(model.firstCluster.back());
    for (std::size_t p = 0; p < model.pages.size(); ++p) {
        const Page& page = model.pages[p];
        for (std::size_t c = 0; c < page.clusters.size(); ++c) {
            const std::uint32_t first = model.firstLevelOf(page, page.clusters[c]);
            const std::uint64_t below = (std::uint64_t{1} << first) - 1;
            levelsOf_[model.firstCluster[p] + c] = ((std::uint64_t{2} << page.level) - 1) & ~below;
        }
    }
}

void LockedEdges::findLocks(const LoadedModel& model) {
    std::vector<FoundLock> found;
    for (std::uint32_t level = 0; level < model.summary.levels.size(); ++level)
        findLocksOfLevel(model, level, found);
    // The sort must be stable, so that the locks of an edge remain in level order.
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [edge, lock] : found) {
        if (edges_.empty() || edges_.back() != edge) {
            edges_.push_back(edge);
            firstLock_.push_back(static_cast<std::uint32_t>(locks_.size()));
        }
        locks_.push_back(lock);
    }
    firstLock_.push_back(static_cast<std::uint32_t>(locks_.size()));
    firstEdge_.assign(positions_.size() + 1, 0);
    for (const std::uint64_t edge : edges_)
        ++firstEdge_[(edge >> 32U) + 1];
    for (std::size_t i = 1; i < firstEdge_.size(); ++i)
        firstEdge_[i] += firstEdge_[i - 1];
}

void LockedEdges::findLocksOfLevel(const LoadedModel& model, std::uint32_t level, std::vector<FoundLock>& found) const {
    std::vector<Use> uses;
    forEachCluster(model, *this, level, [&](std::size_t p, const Cluster& cluster, std::uint64_t owner) {
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
            uses.push_back({positionOf_[firstVertex_[p] + cluster.firstVertex + v], owner});
    });
    std::vector<bool> isShared(positions_.size());
    forEachShared(uses, [&](std::span<const Use> vertex) { isShared[vertex[0].what] = true; });
    uses.clear();
    forEachCluster(model, *this, level, [&](std::size_t p, const Cluster& cluster, std::uint64_t owner) {
        forEachEdge(
            model.pages[p],
            cluster,
            [&](std::uint32_t v) { return positionOf_[firstVertex_[p] + v]; },
            [&](std::uint32_t a, std::uint32_t b) {
                if (isShared[a] && isShared[b] && isOurs(std::min(a, b))) uses.push_back({edgeKey(a, b), owner});
            });
    });
    forEachShared(uses, [&](std::span<const Use> edge) {
        found.emplace_back(edge[0].what, EdgeLock{level, static_cast<std::uint32_t>(edge.size())});
    });
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

} // namespace gnomon::verify
