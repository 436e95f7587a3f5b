#include "hierarchy/codec/cluster_order.h"

#include "hierarchy/codec/connectivity_code.h"
#include "hierarchy/codec/edge_window.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

namespace gnomon::hierarchy {

namespace {

/// A table of the directed edges of all triangles of a cluster, sorted by their start vertex.
class EdgeTable {
public:
    explicit EdgeTable(std::span<const Triangle> triangles) {
        for (const Triangle& triangle : triangles)
            for (const std::uint8_t from : triangle)
                ++end_[from];
        std::uint16_t sum = 0;
        for (std::uint16_t& end : end_)
            end = sum = static_cast<std::uint16_t>(sum + end);
        begin_ = end_;
        for (std::size_t t = triangles.size(); t-- > 0;) // the list of each vertex is filled from its end
            for (std::size_t k = 3; k-- > 0;)
                edges_[--begin_[triangles[t][k]]] = {triangles[t][(k + 1) % 3], static_cast<std::uint8_t>(t)};
    }

    /// Returns the first triangle with the directed edge (from, to) that is not `done`, or nullopt if there is none.
    std::optional<std::uint32_t> find(std::uint32_t from, std::uint32_t to, std::span<const bool> done) const {
        for (std::size_t i = begin_[from]; i < end_[from]; ++i)
            if (edges_[i].to == to && !done[edges_[i].triangle]) return edges_[i].triangle;
        return {};
    }

private:
    static constexpr std::size_t kMaxTriangles = 256; // also the max number of vertices

    struct Edge {
        std::uint8_t to = 0;
        std::uint8_t triangle = 0;
    };

    std::array<std::uint16_t, kMaxTriangles> begin_{};
    std::array<std::uint16_t, kMaxTriangles> end_{};
    std::array<Edge, 3 * kMaxTriangles> edges_{};
};

/// Returns `triangle` with its corners rotated so that it begins with the edge (from, to).
Triangle turned(const Triangle& triangle, std::uint32_t from, std::uint32_t to) {
    for (std::size_t k = 0; k < 3; ++k)
        if (triangle[k] == from && triangle[(k + 1) % 3] == to)
            return {triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
    return triangle;
}

/// Returns the triangles of a cluster in the order of encoding. Each triangle continues across the newest open edge
/// that leads to a remaining triangle.
std::vector<Triangle> walk(std::span<const Triangle> triangles) {
    const EdgeTable edges(triangles);
    std::array<bool, 256> done{};
    std::vector<Triangle> order;
    order.reserve(triangles.size());
    EdgeWindow window;
    // Bit k is set if the open edge of age k may lead to a remaining triangle (age 0 is the newest edge). A cleared
    // bit stays cleared, because triangles are only removed.
    std::uint32_t hopeful = 0;
    std::uint32_t firstLeft = 0;
    const auto take = [&](std::uint32_t index, const Triangle& triangle, bool entered) {
        done[index] = true;
        order.push_back(triangle);
        window.pushTriangle(triangle[0], triangle[1], triangle[2], entered);
        hopeful = (entered ? hopeful << 2U | 3U : hopeful << 3U | 7U) & ((1U << kNotEntered) - 1);
    };
    const auto enterNext = [&] {
        while (hopeful != 0) {
            const OpenEdge edge = window.recent(static_cast<unsigned>(std::countr_zero(hopeful)));
            if (const auto next = edges.find(edge.from, edge.to, done)) {
                take(*next, turned(triangles[*next], edge.from, edge.to), true);
                return true;
            }
            hopeful &= hopeful - 1;
        }
        return false;
    };
    while (order.size() < triangles.size()) {
        if (enterNext()) continue;
        while (done[firstLeft])
            ++firstLeft;
        take(firstLeft, triangles[firstLeft], false);
    }
    return order;
}

/// Renumbers the vertices of a cluster in the order of their first use. Unused vertices come last.
void renumber(std::span<Triangle> triangles, std::span<Vertex> vertices, std::span<std::uint32_t> fields) {
    constexpr int kUnused = -1;
    std::array<int, 256> place{};
    place.fill(kUnused);
    int next = 0;
    for (Triangle& triangle : triangles)
        for (std::uint8_t& corner : triangle) {
            if (place[corner] == kUnused) place[corner] = next++;
            corner = static_cast<std::uint8_t>(place[corner]);
        }
    const std::vector<Vertex> before(vertices.begin(), vertices.end());
    const std::vector<std::uint32_t> fieldsBefore(fields.begin(), fields.end());
    for (std::size_t v = 0; v < before.size(); ++v) {
        if (place[v] == kUnused) place[v] = next++;
        vertices[static_cast<std::size_t>(place[v])] = before[v];
        if (!fields.empty()) fields[static_cast<std::size_t>(place[v])] = fieldsBefore[v];
    }
}

} // namespace

void orderForCoding(Page& page, PageFields& fields) {
    for (const Cluster& cluster : page.clusters) {
        const auto triangles = std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount);
        std::ranges::copy(walk(triangles), triangles.begin());
        const auto words = fields.words.empty()
                               ? std::span<std::uint32_t>()
                               : std::span(fields.words).subspan(cluster.firstVertex, cluster.vertexCount);
        renumber(triangles, std::span(page.vertices).subspan(cluster.firstVertex, cluster.vertexCount), words);
    }
}

} // namespace gnomon::hierarchy
