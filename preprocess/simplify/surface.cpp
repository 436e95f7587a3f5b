#include "preprocess/simplify/surface.h"

#include <algorithm>
#include <limits>

namespace gnomon::simplify {

namespace {

constexpr std::uint32_t kLeafTriangles = 4;

double boxSquare(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& p) {
    const glm::dvec3 d = glm::max(glm::max(low - p, p - high), glm::dvec3(0));
    return glm::dot(d, d);
}

} // namespace

Surface::Surface(std::span<const glm::dvec3> positions, std::vector<Triangle> triangles)
    : positions_(positions),
      triangles_(std::move(triangles)),
      adjacency_(positions.size(), triangles_),
      across_(triangles_.size(), Triangle{hierarchy::kNone, hierarchy::kNone, hierarchy::kNone}) {
    // Max number of visited triangles. It limits the quadratic cost at a position with very many triangles.
    constexpr std::size_t kMaxVisited = 32;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t b = triangles_[t][(i + 1) % 3];
            const auto star = around(triangles_[t][i]);
            for (const std::uint32_t u : star.first(std::min(star.size(), kMaxVisited))) {
                const Triangle& other = triangles_[u];
                if (u == t || (other[0] != b && other[1] != b && other[2] != b)) continue;
                across_[t][i] = u;
                break;
            }
        }
}

void Surface::buildTree(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Node node{glm::dvec3(kInfinity), glm::dvec3(-kInfinity), begin, end, 0};
    for (std::uint32_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            node.low = glm::min(node.low, corner(leaves_[i].triangle, k));
            node.high = glm::max(node.high, corner(leaves_[i].triangle, k));
        }
    nodes_.push_back(node);
    if (end - begin <= kLeafTriangles) return;
    const glm::dvec3 size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        leaves_.begin() + begin, leaves_.begin() + middle, leaves_.begin() + end, [axis](const Leaf& a, const Leaf& b) {
            return a.center[axis] < b.center[axis] || (a.center[axis] == b.center[axis] && a.triangle < b.triangle);
        });
    buildTree(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    buildTree(middle, end);
}

std::uint32_t Surface::nearest(const glm::dvec3& p) {
    if (nodes_.empty()) {
        leaves_.reserve(triangles_.size());
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            leaves_.push_back({glm::vec3(corner(t, 0) + corner(t, 1) + corner(t, 2)), t});
        buildTree(0, static_cast<std::uint32_t>(leaves_.size()));
    }
    double bestSquare = std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    std::array<std::pair<double, std::uint32_t>, 64> stack{};
    std::size_t depth = 0;
    stack[depth++] = {0.0, 0};
    while (depth > 0) {
        const auto [square, index] = stack[--depth];
        if (square >= bestSquare) continue;
        const Node& node = nodes_[index];
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                const double s = squaredDistance(p, leaves_[i].triangle);
                if (s >= bestSquare) continue;
                bestSquare = s;
                best = leaves_[i].triangle;
            }
            continue;
        }
        const Node& a = nodes_[index + 1];
        const Node& b = nodes_[node.right];
        std::pair<double, std::uint32_t> near{boxSquare(a.low, a.high, p), index + 1};
        std::pair<double, std::uint32_t> far{boxSquare(b.low, b.high, p), node.right};
        if (far.first < near.first) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    return best;
}

} // namespace gnomon::simplify
