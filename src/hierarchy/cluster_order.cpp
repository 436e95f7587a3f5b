#include "hierarchy/cluster_order.h"

#include "hierarchy/edge_window.h"

#include <algorithm>
#include <optional>
#include <span>

namespace gnomon::hierarchy {

namespace {

/// Which triangles have a directed edge, by edge.
class EdgeTable {
public:
    explicit EdgeTable(std::span<const Triangle> triangles) {
        entries_.reserve(triangles.size() * 3);
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                entries_.push_back(
                    key(triangles[t][k], triangles[t][(k + 1) % 3]) << 16U | static_cast<std::uint32_t>(t));
        std::sort(entries_.begin(), entries_.end());
    }

    /// The first triangle with edge (from, to) that is not `done`.
    std::optional<std::uint32_t> find(std::uint8_t from, std::uint8_t to, std::span<const bool> done) const {
        const std::uint32_t edge = key(from, to);
        auto it = std::lower_bound(entries_.begin(), entries_.end(), edge << 16U);
        for (; it != entries_.end() && *it >> 16U == edge; ++it)
            if (!done[*it & 0xFFFFU]) return *it & 0xFFFFU;
        return {};
    }

private:
    static std::uint32_t key(std::uint8_t from, std::uint8_t to) { return static_cast<std::uint32_t>(from) << 8U | to; }

    std::vector<std::uint32_t> entries_; // edge << 16 | triangle
};

/// `triangle` turned so that it begins with edge (from, to).
Triangle turned(const Triangle& triangle, std::uint8_t from, std::uint8_t to) {
    for (std::size_t k = 0; k < 3; ++k)
        if (triangle[k] == from && triangle[(k + 1) % 3] == to) return {from, to, triangle[(k + 2) % 3]};
    return triangle;
}

/// Triangles one after the other across the newest open edge that leads to one.
std::vector<Triangle> walk(std::span<const Triangle> triangles) {
    const EdgeTable edges(triangles);
    std::array<bool, 256> done{};
    std::vector<Triangle> order;
    order.reserve(triangles.size());
    EdgeWindow window;
    std::uint32_t firstLeft = 0;
    const auto take = [&](std::uint32_t index, const Triangle& triangle, bool entered) {
        done[index] = true;
        order.push_back(triangle);
        window.pushTriangle(triangle[0], triangle[1], triangle[2], entered);
    };
    while (order.size() < triangles.size()) {
        bool found = false;
        for (unsigned age = 0; age < std::min(window.count(), 15U) && !found; ++age) {
            const OpenEdge edge = window.recent(age);
            const auto next = edges.find(edge.from, edge.to, done);
            if (!next) continue;
            take(*next, turned(triangles[*next], edge.from, edge.to), true);
            found = true;
        }
        if (found) continue;
        while (done[firstLeft])
            ++firstLeft;
        take(firstLeft, triangles[firstLeft], false);
    }
    return order;
}

/// Renumbers vertices by first use; those that no triangle uses come last.
void renumber(std::span<Triangle> triangles, std::span<Vertex> vertices) {
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
    for (std::size_t v = 0; v < before.size(); ++v) {
        if (place[v] == kUnused) place[v] = next++;
        vertices[static_cast<std::size_t>(place[v])] = before[v];
    }
}

} // namespace

void orderForCoding(Page& page) {
    for (const Cluster& cluster : page.clusters) {
        const auto triangles = std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount);
        std::ranges::copy(walk(triangles), triangles.begin());
        renumber(triangles, std::span(page.vertices).subspan(cluster.firstVertex, cluster.vertexCount));
    }
}

} // namespace gnomon::hierarchy
