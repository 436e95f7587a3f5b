#include "preprocess/levels/cluster.h"

#include "preprocess/levels/kd_split.h"
#include "preprocess/levels/local_numbers.h"
#include "preprocess/simplify/union_find.h"

#include <algorithm>

namespace gnomon::levels {

namespace {

using Positions = std::span<const glm::vec3>;

/// The items that a kd-tree sorts into clusters. A small connected piece is one item. Each triangle of a large piece is
/// one item.
struct Items {
    std::vector<KdItem> items;
    std::vector<std::uint32_t> first; // index of each item's first triangle in `members`
    std::vector<std::uint32_t> members;
};

struct ClusterInput {
    std::span<const simplify::Triangle> triangles;
    std::span<const std::uint32_t> positionOf;
    Positions positions;

    glm::vec3 center(std::uint32_t t) const {
        const simplify::Triangle& v = triangles[t];
        return (positions[positionOf[v[0]]] + positions[positionOf[v[1]]] + positions[positionOf[v[2]]]) * (1.0F / 3);
    }
};

/// Returns for each triangle the number of its connected piece. Pieces are numbered in the order of their first
/// triangles. `count` receives their number.
std::vector<std::uint32_t> pieces(const ClusterInput& input, std::uint32_t& count) {
    simplify::UnionFind sets(static_cast<std::uint32_t>(input.positions.size()));
    for (const simplify::Triangle& t : input.triangles) {
        sets.unite(input.positionOf[t[0]], input.positionOf[t[1]]);
        sets.unite(input.positionOf[t[1]], input.positionOf[t[2]]);
    }
    std::vector<std::uint32_t> number(input.positions.size(), hierarchy::kNone);
    std::vector<std::uint32_t> pieceOf(input.triangles.size());
    count = 0;
    for (std::size_t t = 0; t < input.triangles.size(); ++t) {
        std::uint32_t& piece = number[sets.root(input.positionOf[input.triangles[t][0]])];
        if (piece == hierarchy::kNone) piece = count++;
        pieceOf[t] = piece;
    }
    return pieceOf;
}

Items itemsOf(const ClusterInput& input, std::uint32_t maxTriangles) {
    std::uint32_t pieceCount = 0;
    const std::vector<std::uint32_t> pieceOf = pieces(input, pieceCount);
    std::vector<std::uint32_t> size(pieceCount, 0);
    for (const std::uint32_t piece : pieceOf)
        ++size[piece];
    Items result;
    std::vector<std::uint32_t> itemOfPiece(pieceCount, hierarchy::kNone);
    std::vector<std::uint32_t> itemOf(pieceOf.size());
    for (std::uint32_t t = 0; t < pieceOf.size(); ++t) {
        const bool isWhole = size[pieceOf[t]] <= maxTriangles;
        std::uint32_t item = isWhole ? itemOfPiece[pieceOf[t]] : hierarchy::kNone;
        if (item == hierarchy::kNone) {
            item = static_cast<std::uint32_t>(result.items.size());
            result.items.push_back({glm::vec3(0), 0, item});
            if (isWhole) itemOfPiece[pieceOf[t]] = item;
        }
        result.items[item].center += input.center(t);
        ++result.items[item].weight;
        itemOf[t] = item;
    }
    result.first.assign(result.items.size() + 1, 0);
    for (KdItem& item : result.items) {
        item.center *= 1.0F / static_cast<float>(item.weight);
        result.first[item.index + 1] = result.first[item.index] + item.weight;
    }
    result.members.resize(pieceOf.size());
    std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
    for (std::uint32_t t = 0; t < itemOf.size(); ++t)
        result.members[next[itemOf[t]]++] = t;
    return result;
}

std::uint32_t vertexCount(const ClusterInput& input, std::span<const std::uint32_t> cluster, LocalNumbers& numbers) {
    numbers.begin();
    for (const std::uint32_t t : cluster)
        for (const std::uint32_t v : input.triangles[t])
            numbers.of(v);
    return static_cast<std::uint32_t>(numbers.ids().size());
}

/// Appends `cluster` to `out`. A cluster with too many vertices is split into halves until each half has few enough.
void appendFitting(
    const ClusterInput& input, std::span<const std::uint32_t> cluster, LocalNumbers& numbers, Clustering& out) {
    if (const std::uint32_t vertices = vertexCount(input, cluster, numbers); vertices <= kMaxClusterVertices) {
        out.order.insert(out.order.end(), cluster.begin(), cluster.end());
        out.ends.push_back(static_cast<std::uint32_t>(out.order.size()));
        out.vertexCounts.push_back(vertices);
        return;
    }
    std::vector<KdItem> items;
    items.reserve(cluster.size());
    for (const std::uint32_t t : cluster)
        items.push_back({input.center(t), 1, t});
    const KdParts halves = kdSplit(items, (cluster.size() + 1) / 2, 0.5);
    std::uint32_t begin = 0;
    for (const std::uint32_t end : halves.ends) {
        appendFitting(input, std::span(halves.order).subspan(begin, end - begin), numbers, out);
        begin = end;
    }
}

} // namespace

Clustering clusterTriangles(
    std::span<const simplify::Triangle> triangles,
    std::span<const std::uint32_t> positionOf,
    std::span<const glm::vec3> positions,
    std::uint32_t maxTriangles) {
    const ClusterInput input{triangles, positionOf, positions};
    const Items items = itemsOf(input, maxTriangles);
    const KdParts parts = kdSplit(items.items, maxTriangles, 0.5);
    Clustering result;
    result.order.reserve(triangles.size());
    std::uint32_t begin = 0;
    std::vector<std::uint32_t> cluster;
    LocalNumbers numbers(positionOf.size());
    for (const std::uint32_t end : parts.ends) {
        cluster.clear();
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t item = parts.order[i];
            cluster.insert(
                cluster.end(),
                items.members.begin() + items.first[item],
                items.members.begin() + items.first[item + 1]);
        }
        appendFitting(input, cluster, numbers, result);
        begin = end;
    }
    return result;
}

} // namespace gnomon::levels
