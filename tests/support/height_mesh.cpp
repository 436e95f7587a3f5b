#include "tests/support/height_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace gnomon::tests {

namespace {

using Positions = std::span<const glm::dvec3>;

/// Twice the area of a triangle seen from above; positive if it is counter-clockwise.
double groundArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
}

/// The height at the ground point of `p` of the plane through a, b, c.
double heightAt(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double area = groundArea(a, b, c);
    return (a.y * groundArea(p, b, c) + b.y * groundArea(a, p, c) + c.y * groundArea(a, b, p)) / area;
}

bool covers(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return groundArea(p, b, c) >= 0 && groundArea(a, p, c) >= 0 && groundArea(a, b, p) >= 0;
}

HeightTriangle replaced(HeightTriangle triangle, std::uint32_t from, std::uint32_t to) {
    std::replace(triangle.begin(), triangle.end(), from, to);
    return triangle;
}

bool has(const HeightTriangle& triangle, std::uint32_t vertex) {
    return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

/// Moving `vertex` onto `target`, and what it costs.
struct Collapse {
    double cost = std::numeric_limits<double>::infinity();
    std::uint32_t vertex = 0;
    std::uint32_t target = 0;

    bool operator<(const Collapse& other) const {
        return std::tie(cost, vertex, target) < std::tie(other.cost, other.vertex, other.target);
    }
};

/// The cost of one collapse: the change of height over the vertex; infinite if a triangle would flip.
double collapseCost(std::span<const HeightTriangle> star, Positions positions, std::uint32_t v, std::uint32_t w) {
    double cost = std::numeric_limits<double>::infinity();
    for (const HeightTriangle& triangle : star) {
        if (has(triangle, w)) continue;
        const HeightTriangle t = replaced(triangle, v, w);
        const glm::dvec3& a = positions[t[0]];
        const glm::dvec3& b = positions[t[1]];
        const glm::dvec3& c = positions[t[2]];
        if (groundArea(a, b, c) <= 1e-9) return std::numeric_limits<double>::infinity();
        if (covers(positions[v], a, b, c)) cost = std::abs(heightAt(positions[v], a, b, c) - positions[v].y);
    }
    return cost;
}

using Stars = std::map<std::uint32_t, std::vector<HeightTriangle>>;

/// The cheapest collapse of each vertex that can go, cheapest first.
std::vector<Collapse> possibleCollapses(const Stars& stars, Positions positions) {
    std::vector<Collapse> collapses;
    for (const auto& [v, star] : stars) {
        Collapse best;
        for (const HeightTriangle& triangle : star)
            for (const std::uint32_t w : triangle)
                if (w != v) best = std::min(best, Collapse{collapseCost(star, positions, v, w), v, w});
        if (std::isfinite(best.cost)) collapses.push_back(best);
    }
    std::sort(collapses.begin(), collapses.end());
    return collapses;
}

/// Chooses collapses whose triangles do not touch, until `count` triangles have gone: where each vertex moves.
std::map<std::uint32_t, std::uint32_t> independentMoves(
    const std::vector<Collapse>& collapses, const Stars& stars, std::size_t count) {
    std::set<std::uint32_t> touched;
    std::map<std::uint32_t, std::uint32_t> moves;
    for (const Collapse& collapse : collapses) {
        if (2 * moves.size() >= count) break;
        std::set<std::uint32_t> around;
        for (const HeightTriangle& triangle : stars.at(collapse.vertex))
            around.insert(triangle.begin(), triangle.end());
        if (std::ranges::any_of(around, [&touched](std::uint32_t v) { return touched.count(v) != 0; })) continue;
        touched.insert(around.begin(), around.end());
        moves[collapse.vertex] = collapse.target;
    }
    return moves;
}

/// One pass over independent vertices; whether anything went.
bool decimateOnce(
    std::vector<HeightTriangle>& triangles,
    Positions positions,
    const std::function<bool(std::uint32_t)>& isLocked,
    std::size_t target) {
    Stars stars;
    for (const HeightTriangle& triangle : triangles)
        for (const std::uint32_t v : triangle)
            if (!isLocked(v)) stars[v].push_back(triangle);
    const auto moves = independentMoves(possibleCollapses(stars, positions), stars, triangles.size() - target);
    for (HeightTriangle& triangle : triangles)
        for (std::uint32_t& v : triangle)
            if (const auto move = moves.find(v); move != moves.end()) v = move->second;
    std::erase_if(triangles, [](const HeightTriangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return !moves.empty();
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Each edge once.
std::vector<Edge> edgesOf(std::span<const HeightTriangle> triangles) {
    std::vector<Edge> edges;
    for (const HeightTriangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            edges.emplace_back(std::minmax(t[k], t[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// The difference of height where the edges ab and cd cross over the ground; 0 if they do not.
double crossingDeviation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x)) return 0;
    if (std::max(a.z, b.z) < std::min(c.z, d.z) || std::max(c.z, d.z) < std::min(a.z, b.z)) return 0;
    const double sideA = groundArea(c, d, a);
    const double sideB = groundArea(c, d, b);
    const double sideC = groundArea(a, b, c);
    const double sideD = groundArea(a, b, d);
    if (sideA * sideB >= 0 || sideC * sideD >= 0) return 0;
    const double s = sideA / (sideA - sideB);
    const double t = sideC / (sideC - sideD);
    return std::abs(a.y + s * (b.y - a.y) - (c.y + t * (d.y - c.y)));
}

} // namespace

std::vector<HeightTriangle> decimated(
    std::span<const HeightTriangle> triangles,
    std::span<const glm::dvec3> positions,
    const std::function<bool(std::uint32_t)>& isLocked,
    std::size_t target) {
    std::vector<HeightTriangle> result(triangles.begin(), triangles.end());
    while (result.size() > target && decimateOnce(result, positions, isLocked, target)) {
    }
    return result;
}

double verticalDeviation(
    std::span<const HeightTriangle> fine,
    std::span<const HeightTriangle> coarse,
    std::span<const glm::dvec3> positions) {
    double deviation = 0;
    std::vector<std::uint32_t> vertices;
    for (const HeightTriangle& t : fine)
        vertices.insert(vertices.end(), t.begin(), t.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices)
        for (const HeightTriangle& t : coarse)
            if (covers(positions[v], positions[t[0]], positions[t[1]], positions[t[2]]))
                deviation = std::max(
                    deviation,
                    std::abs(
                        heightAt(positions[v], positions[t[0]], positions[t[1]], positions[t[2]]) - positions[v].y));
    const std::vector<Edge> coarseEdges = edgesOf(coarse);
    for (const auto& [a, b] : edgesOf(fine))
        for (const auto& [c, d] : coarseEdges)
            deviation = std::max(deviation, crossingDeviation(positions[a], positions[b], positions[c], positions[d]));
    return deviation;
}

} // namespace gnomon::tests
