#include "path/solid_spans.h"

#include <cmath>

namespace gnomon::path {

namespace {

constexpr std::uint32_t kNoNode = 0xFFFFFFFFU;

/// A triangle that has been clipped to a column: each of four planes adds at most one corner.
struct Polygon { // NOLINT(cppcoreguidelines-pro-type-member-init): made for each column of each triangle
    std::array<glm::dvec3, 8> corners;
    std::size_t count = 0;
};

/// Clips `polygon` at the coordinate `bound` along `axis`. Returns the part above it if `sign` is 1, or below it if
/// `sign` is -1.
Polygon clipped(const Polygon& polygon, glm::length_t axis, double bound, double sign) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.corners[i];
        const glm::dvec3& b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        const double fromA = sign * (a[axis] - bound);
        const double fromB = sign * (b[axis] - bound);
        if (fromA >= 0) result.corners[result.count++] = a;
        if ((fromA >= 0) != (fromB >= 0) && result.count < result.corners.size())
            result.corners[result.count++] = a + (b - a) * (fromA / (fromA - fromB));
    }
    return result;
}

Polygon between(const Polygon& polygon, glm::length_t axis, double low, double high) {
    return clipped(clipped(polygon, axis, low, 1), axis, high, -1);
}

struct Range {
    double low = 0;
    double high = 0;
};

Range rangeAlong(const Polygon& polygon, glm::length_t axis) {
    Range range{polygon.corners[0][axis], polygon.corners[0][axis]};
    for (std::size_t i = 1; i < polygon.count; ++i) {
        range.low = std::min(range.low, polygon.corners[i][axis]);
        range.high = std::max(range.high, polygon.corners[i][axis]);
    }
    return range;
}

/// The range of columns, within `count` columns, that intersect `range` extended by `margin`. It is empty if first >
/// last.
struct Columns {
    std::int32_t first = 0;
    std::int32_t last = -1;

    Columns(const Range& range, double margin, double cell, std::int32_t count) {
        const double low = std::floor((range.low - margin) / cell);
        const double high = std::floor((range.high + margin) / cell);
        if (high < 0 || low >= count) return;
        first = static_cast<std::int32_t>(std::max(low, 0.0));
        last = static_cast<std::int32_t>(std::min(high, count - 1.0));
    }
};

std::int32_t columnsOver(double extent, double cell) {
    return static_cast<std::int32_t>(std::floor(extent / cell)) + 1;
}

} // namespace

ColumnGrid::ColumnGrid(const Box& region, double side, double step)
    : origin(region.min),
      cell(side),
      rise(step),
      width(columnsOver(region.extent().x, cell)),
      depth(columnsOver(region.extent().z, cell)) {}

SolidSpans::SolidSpans(const ColumnGrid& grid, std::int32_t headroom, double margin)
    : grid_(grid), headroom_(headroom), margin_(margin), first_(grid.columnCount(), kNoNode) {}

void SolidSpans::add(const std::array<glm::dvec3, 3>& corners) {
    Polygon triangle{};
    for (const glm::dvec3& corner : corners)
        triangle.corners[triangle.count++] = corner - grid_.origin;
    const Columns acrossWhole(rangeAlong(triangle, 0), margin_, grid_.cell, grid_.width);
    const Columns rows(rangeAlong(triangle, 2), margin_, grid_.cell, grid_.depth);
    for (std::int32_t z = rows.first; z <= rows.last && acrossWhole.first <= acrossWhole.last; ++z) {
        const bool isOneRow = rows.first == rows.last;
        const Polygon row =
            isOneRow ? triangle : between(triangle, 2, z * grid_.cell - margin_, (z + 1) * grid_.cell + margin_);
        if (row.count == 0) continue;
        const Columns across(rangeAlong(row, 0), margin_, grid_.cell, grid_.width);
        for (std::int32_t x = across.first; x <= across.last; ++x) {
            const bool isOneColumn = across.first == across.last;
            const Polygon part =
                isOneColumn ? row : between(row, 0, x * grid_.cell - margin_, (x + 1) * grid_.cell + margin_);
            if (part.count == 0) continue;
            const Range heights = rangeAlong(part, 1);
            insert(x, z, heights.low - margin_, heights.high + margin_);
        }
    }
}

void SolidSpans::insert(std::int32_t x, std::int32_t z, double low, double high) {
    SolidSpan span{
        static_cast<std::int32_t>(std::floor(low / grid_.rise)),
        static_cast<std::int32_t>(std::ceil(high / grid_.rise))};
    span.top = std::max(span.top, span.bottom + 1);
    std::uint32_t* link =
        &first_[static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.width) + static_cast<std::size_t>(x)];
    while (*link != kNoNode && nodes_[*link].span.top + headroom_ <= span.bottom)
        link = &nodes_[*link].next;
    while (*link != kNoNode && nodes_[*link].span.bottom < span.top + headroom_) { // merged with the new span
        const std::uint32_t node = *link;
        span.bottom = std::min(span.bottom, nodes_[node].span.bottom);
        span.top = std::max(span.top, nodes_[node].span.top);
        *link = nodes_[node].next;
        unused_.push_back(node);
    }
    const std::uint32_t after = *link;
    if (unused_.empty()) {
        // The link must be written before nodes_ grows, because it may be inside nodes_.
        *link = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({span, after});
        return;
    }
    *link = unused_.back();
    unused_.pop_back();
    nodes_[*link] = {span, after};
}

void SolidSpans::read(std::int32_t x, std::int32_t z, std::vector<SolidSpan>& spans) const {
    spans.clear();
    const std::size_t column =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.width) + static_cast<std::size_t>(x);
    for (std::uint32_t node = first_[column]; node != kNoNode; node = nodes_[node].next)
        spans.push_back(nodes_[node].span);
}

} // namespace gnomon::path
