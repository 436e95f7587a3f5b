#include "preprocess/verify/triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

namespace gnomon::verify {

namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::uint32_t kParallelTriangles = 1U << 14U;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double squaredLength(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double squaredDistanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double length = squaredLength(ab);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
    return squaredLength(p - (a + t * ab));
}

} // namespace

double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 ap = p - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    const glm::dvec3 bp = p - b;
    const double d3 = glm::dot(ab, bp);
    const double d4 = glm::dot(ac, bp);
    const glm::dvec3 cp = p - c;
    const double d5 = glm::dot(ab, cp);
    const double d6 = glm::dot(ac, cp);
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    const double sum = va + vb + vc;
    double minSquare = std::min(
        {squaredDistanceToSegment(p, a, b), squaredDistanceToSegment(p, b, c), squaredDistanceToSegment(p, c, a)});
    // Rounding can make the barycentric weights of a sliver wrong. Positive weights nevertheless describe a point of
    // the triangle.
    if (va > 0 && vb > 0 && vc > 0)
        minSquare = std::min(minSquare, squaredLength(p - (a + ab * (vb / sum) + ac * (vc / sum))));
    return minSquare;
}

struct TriangleTree::Item {
    std::array<float, 3> centre;
    std::uint32_t triangle;
};

double TriangleTree::Bounds::squaredDistance(const glm::dvec3& point) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = point[static_cast<int>(axis)];
        const double outside = std::max({min[axis] - x, x - max[axis], 0.0});
        sum += outside * outside;
    }
    return sum;
}

TriangleTree::TriangleTree(const TriangleSoup& soup) : soup_(soup) {
    const auto count = static_cast<std::uint32_t>(soup.triangles.size());
    if (count == 0) return;
    std::vector<Item> items(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 centre((soup.corner(i, 0) + soup.corner(i, 1) + soup.corner(i, 2)) / 3.0);
        items[i] = {{centre.x, centre.y, centre.z}, i};
    }
    order_.resize(count);
    nodes_.resize(count);
    build(items, 0, 0, count);
}

TriangleTree::Bounds TriangleTree::buildLeaf(
    const std::vector<Item>& items, Node& node, std::uint32_t begin, std::uint32_t end) {
    node.next = begin;
    node.count = end - begin;
    node.bounds.min.fill(kInfinity);
    node.bounds.max.fill(-kInfinity);
    for (std::uint32_t i = begin; i < end; ++i) {
        order_[i] = items[i].triangle;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto x = static_cast<float>(soup_.corner(items[i].triangle, k)[static_cast<int>(axis)]);
                node.bounds.min[axis] = std::min(node.bounds.min[axis], std::nextafter(x, -kInfinity));
                node.bounds.max[axis] = std::max(node.bounds.max[axis], std::nextafter(x, kInfinity));
            }
    }
    return node.bounds;
}

TriangleTree::Bounds TriangleTree::build(
    std::vector<Item>& items, std::uint32_t index, std::uint32_t begin, std::uint32_t end) {
    Node& node = nodes_[index];
    if (end - begin <= kLeafTriangles) return buildLeaf(items, node, begin, end);
    std::array<float, 3> low{kInfinity, kInfinity, kInfinity};
    std::array<float, 3> high{-kInfinity, -kInfinity, -kInfinity};
    for (std::uint32_t i = begin; i < end; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], items[i].centre[axis]);
            high[axis] = std::max(high[axis], items[i].centre[axis]);
        }
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
        if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&items](std::uint32_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Item& a, const Item& b) {
        return a.centre[axis] < b.centre[axis];
    });
    // In a tree of several leaves, each leaf has at least two triangles. n triangles therefore need fewer than n nodes.
    // The right subtree can thus start at a known index after the left subtree, and threads need no shared counter.
    node.next = index + (middle - begin);
    Bounds left;
    Bounds right;
    const auto buildLeft = [&] { left = build(items, index + 1, begin, middle); };
    const auto buildRight = [&] { right = build(items, node.next, middle, end); };
    if (end - begin > kParallelTriangles) {
        tbb::parallel_invoke(buildLeft, buildRight);
    } else {
        buildLeft();
        buildRight();
    }
    for (axis = 0; axis < 3; ++axis) {
        node.bounds.min[axis] = std::min(left.min[axis], right.min[axis]);
        node.bounds.max[axis] = std::max(left.max[axis], right.max[axis]);
    }
    return node.bounds;
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& point, std::uint32_t hint) const {
    Nearest best;
    if (nodes_.empty()) return best;
    double square = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::uint32_t triangle) {
        const double found =
            squaredDistance(point, soup_.corner(triangle, 0), soup_.corner(triangle, 1), soup_.corner(triangle, 2));
        if (found >= square) return;
        square = found;
        best.triangle = triangle;
    };
    if (hint < soup_.triangles.size()) consider(hint);

    struct Entry {
        std::uint32_t node;
        double square;
    };

    std::array<Entry, 64> stack{}; // sufficient for 2^32 triangles, because each node halves its triangles
    std::size_t size = 0;
    stack[size++] = {0, nodes_[0].bounds.squaredDistance(point)};
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.square >= square) continue;
        const Node& node = nodes_[entry.node];
        for (std::uint32_t i = 0; i < node.count; ++i)
            consider(order_[node.next + i]);
        if (node.count > 0) continue;
        Entry near{entry.node + 1, nodes_[entry.node + 1].bounds.squaredDistance(point)};
        Entry far{node.next, nodes_[node.next].bounds.squaredDistance(point)};
        if (far.square < near.square) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    best.distance = std::sqrt(square);
    return best;
}

} // namespace gnomon::verify
