#include "hierarchy/cluster_order.h"

#include "hierarchy/edge_window.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace gnomon::hierarchy {

namespace {

/// Which triangles have a directed edge, by edge: a table with open addressing, at most three quarters full.
class EdgeTable {
public:
    explicit EdgeTable(std::span<const Triangle> triangles) {
        entries_.fill(kEmpty);
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                insert(key(triangles[t][k], triangles[t][(k + 1) % 3]) << 16U | t);
    }

    /// The first triangle with edge (from, to) that is not `done`.
    std::optional<std::uint32_t> find(std::uint32_t from, std::uint32_t to, std::span<const bool> done) const {
        const std::uint32_t edge = key(from, to);
        for (std::size_t i = home(edge); entries_[i] != kEmpty; i = (i + 1) % kSize)
            if (entries_[i] >> 16U == edge && !done[entries_[i] & 0xFFFFU]) return entries_[i] & 0xFFFFU;
        return {};
    }

private:
    static constexpr std::size_t kSize = 1024; // for three edges of each of at most 256 triangles
    static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;

    static std::uint32_t key(std::uint32_t from, std::uint32_t to) { return from << 8U | to; }

    static std::size_t home(std::uint32_t edge) { return (edge * 0x9E3779B1U) >> 22U; }

    /// Entries of one edge are met in the order in which they came.
    void insert(std::uint32_t entry) {
        std::size_t i = home(entry >> 16U);
        while (entries_[i] != kEmpty)
            i = (i + 1) % kSize;
        entries_[i] = entry;
    }

    std::array<std::uint32_t, kSize> entries_{}; // edge << 16 | triangle
};

/// `triangle` turned so that it begins with edge (from, to).
Triangle turned(const Triangle& triangle, std::uint32_t from, std::uint32_t to) {
    for (std::size_t k = 0; k < 3; ++k)
        if (triangle[k] == from && triangle[(k + 1) % 3] == to)
            return {triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
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
