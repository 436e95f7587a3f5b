#include "preprocess/proximity/point_tree.h"

#include "hierarchy/model.h"

#include <algorithm>
#include <limits>

namespace gnomon::proximity {

namespace {

constexpr std::uint32_t kSearched = 12; // max number of points per leaf; a query tests all points of a leaf

} // namespace

PointTree::PointTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> components) {
    points_.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        points_.push_back({{points[i].x, points[i].y, points[i].z}, i, components[i]});
    nodes_.reserve(points.size() / 3 + 1);
    build(0, static_cast<std::uint32_t>(points_.size()));
}

void PointTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({begin, end});
    if (end - begin <= kSearched) return;
    Place low = points_[begin].place;
    Place high = low;
    for (std::uint32_t i = begin; i < end; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], points_[i].place[axis]);
            high[axis] = std::max(high[axis], points_[i].place[axis]);
        }
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
        if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
    const double plane = low[axis] + (high[axis] - low[axis]) * 0.5;
    std::uint32_t middle = begin;
    for (std::uint32_t i = begin; i < end; ++i) { // no branch, because the CPU cannot predict on which side a point is
        const Point point = points_[i];
        points_[i] = points_[middle];
        points_[middle] = point;
        middle += point.place[axis] < plane ? 1 : 0;
    }
    // There is no number between the two coordinates, so the points cannot be split.
    if (middle == begin || middle == end) return;
    nodes_[index].plane = plane;
    nodes_[index].axis = static_cast<std::uint32_t>(axis);
    build(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end);
}

std::uint32_t PointTree::nearest(const glm::dvec3& place, std::uint32_t component) const {
    Query query{{place.x, place.y, place.z}, component, std::numeric_limits<double>::infinity(), hierarchy::kNone};
    if (!points_.empty()) visit(0, query);
    return query.best;
}

void PointTree::visit(std::uint32_t index, Query& query) const {
    const Node& node = nodes_[index];
    if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Point& point = points_[i];
            if (point.component == query.component) continue;
            const double x = point.place[0] - query.place[0];
            const double y = point.place[1] - query.place[1];
            const double z = point.place[2] - query.place[2];
            const double square = x * x + y * y + z * z;
            if (square > query.bestSquare || (square == query.bestSquare && point.index > query.best)) continue;
            query.bestSquare = square;
            query.best = point.index;
        }
        return;
    }
    const double side = query.place[node.axis] - node.plane;
    visit(side < 0 ? index + 1 : node.right, query);
    if (side * side <= query.bestSquare) visit(side < 0 ? node.right : index + 1, query);
}

} // namespace gnomon::proximity
