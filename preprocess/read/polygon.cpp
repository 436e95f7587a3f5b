#include "preprocess/read/polygon.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

namespace gnomon::read {

namespace {

// Twice the signed area of a, b, c; positive when they turn left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Newell's normal of the closed loop (Sutherland, Sproull, Schumacker 1974): its components are the projected areas.
glm::dvec3 newellNormal(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0);
    glm::dvec3 last = corners.back() - corners.front();
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 current = corner - corners.front();
        normal += glm::cross(last, current);
        last = current;
    }
    return normal;
}

// The loop in a plane where it turns left as a whole: the axis nearest the normal is left out.
std::vector<glm::dvec2> flatten(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int u = (dropped + 1) % 3;
    int v = (dropped + 2) % 3;
    if (normal[dropped] < 0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 relative = corner - corners.front();
        flat.emplace_back(relative[u], relative[v]);
    }
    return flat;
}

bool isStrictlyConvex(std::span<const glm::dvec2> loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(turn(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) > 0)) return false;
    return true;
}

// Finds points near a triangle without asking all of them: square cells over their bounding box, in one array.
class PointCells {
public:
    PointCells(std::span<const glm::dvec2> points, const std::vector<std::uint32_t>& indices) {
        glm::dvec2 max(-std::numeric_limits<double>::infinity());
        for (const std::uint32_t i : indices) {
            min_ = glm::min(min_, points[i]);
            max = glm::max(max, points[i]);
        }
        constexpr double kPointsPerCell = 4;
        const double side = std::ceil(std::sqrt(static_cast<double>(indices.size()) / kPointsPerCell));
        side_ = static_cast<std::size_t>(std::max(side, 1.0));
        scale_ = glm::dvec2(static_cast<double>(side_)) / (max - min_);
        // Counting sort: begins_[cell] is first the number of points before the cell, then where its next point goes.
        begins_.assign(side_ * side_ + 2, 0);
        for (const std::uint32_t i : indices)
            ++begins_[cellOf(points[i]) + 2];
        for (std::size_t cell = 2; cell < begins_.size(); ++cell)
            begins_[cell] += begins_[cell - 1];
        sorted_.resize(indices.size());
        for (const std::uint32_t i : indices)
            sorted_[begins_[cellOf(points[i]) + 1]++] = i;
    }

    /// Calls `test(index)` for every point that may lie between `low` and `high`, until one call is true; whether one
    /// was.
    template <class Test>
    bool any(const glm::dvec2& low, const glm::dvec2& high, Test test) const {
        for (std::size_t y = along(low, 1); y <= along(high, 1); ++y) {
            const std::size_t row = y * side_;
            for (std::uint32_t i = begins_[row + along(low, 0)]; i < begins_[row + along(high, 0) + 1]; ++i)
                if (test(sorted_[i])) return true;
        }
        return false;
    }

private:
    // Never decreases with the coordinate; what is no number is in cell 0.
    std::size_t along(const glm::dvec2& point, int axis) const {
        const double cell = (point[axis] - min_[axis]) * scale_[axis];
        const auto last = static_cast<double>(side_ - 1);
        return cell > 0 ? static_cast<std::size_t>(std::min(cell, last)) : 0;
    }

    std::size_t cellOf(const glm::dvec2& point) const { return along(point, 1) * side_ + along(point, 0); }

    glm::dvec2 min_{std::numeric_limits<double>::infinity()};
    glm::dvec2 scale_{0};
    std::size_t side_ = 1;
    std::vector<std::uint32_t> begins_; ///< where a cell's points begin in sorted_; one more for the end
    std::vector<std::uint32_t> sorted_;
};

class EarClipper {
public:
    EarClipper(std::vector<glm::dvec2> loop, std::vector<PolygonTriangle>& out)
        : points_(std::move(loop)), links_(points_.size()), left_(points_.size()), out_(out) {
        const auto n = static_cast<std::uint32_t>(points_.size());
        for (std::uint32_t i = 0; i < n; ++i)
            links_[i] = {(i + n - 1) % n, (i + 1) % n, false, false};
        std::vector<std::uint32_t> blockers;
        for (std::uint32_t i = 0; i < n; ++i) {
            links_[i].isBlocker = !isConvex(i);
            if (links_[i].isBlocker) blockers.push_back(i);
        }
        cells_.emplace(points_, blockers);
    }

    void run() {
        std::deque<std::uint32_t> candidates;
        bool foundSinceScan = true;
        const std::uint64_t mostWork = kMostWorkPerCorner * points_.size();
        while (left_ > 3 && work_ < mostWork) {
            if (candidates.empty()) {
                // Clipping can free corners far away, so all are asked again before the loop is taken for a bad one.
                if (!foundSinceScan) clip(leastBadCorner());
                candidates = remaining();
                work_ += candidates.size();
                foundSinceScan = false;
                continue;
            }
            const std::uint32_t corner = candidates.front();
            candidates.pop_front();
            if (links_[corner].isGone || !isEar(corner)) continue;
            candidates.push_back(links_[corner].previous);
            candidates.push_back(links_[corner].next);
            clip(corner);
            foundSinceScan = true;
        }
        const std::uint32_t tip = remaining().front();
        while (left_ > 3)
            clip(links_[tip].next);
        out_.push_back({links_[tip].previous, tip, links_[tip].next});
    }

private:
    // Simple loops stay far below this; it ends the search in huge loops that cross themselves everywhere.
    static constexpr std::uint64_t kMostWorkPerCorner = 10'000;

    struct Link {
        std::uint32_t previous;
        std::uint32_t next;
        bool isGone;
        bool isBlocker; ///< not convex
    };

    bool isConvex(std::uint32_t i) const {
        return turn(points_[links_[i].previous], points_[i], points_[links_[i].next]) > 0;
    }

    std::deque<std::uint32_t> remaining() const {
        std::deque<std::uint32_t> result;
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            if (!links_[i].isGone) result.push_back(i);
        return result;
    }

    // An ear: a convex corner whose triangle holds no other corner. Only corners that are not convex can be the first
    // to reach into it.
    bool isEar(std::uint32_t i) {
        if (!isConvex(i)) return false;
        const glm::dvec2& a = points_[links_[i].previous];
        const glm::dvec2& b = points_[i];
        const glm::dvec2& c = points_[links_[i].next];
        return !cells_->any(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](std::uint32_t blocker) {
            ++work_;
            return links_[blocker].isBlocker && blocks(blocker, i);
        });
    }

    bool blocks(std::uint32_t blocker, std::uint32_t corner) const {
        const std::uint32_t before = links_[corner].previous;
        const std::uint32_t after = links_[corner].next;
        if (blocker == before || blocker == corner || blocker == after) return false;
        const glm::dvec2& a = points_[before];
        const glm::dvec2& b = points_[corner];
        const glm::dvec2& c = points_[after];
        const glm::dvec2& p = points_[blocker];
        // A loop may touch itself. Along the bridge to a hole, a twin of an end of the ear blocks nothing; a twin of
        // the ear's tip blocks if it is a notch that opens into the ear.
        if (p == a || p == c) return false;
        if (p == b) {
            const auto leadsInside = [&](std::uint32_t other) {
                return turn(a, b, points_[other]) >= 0 && turn(b, c, points_[other]) >= 0;
            };
            return leadsInside(links_[blocker].previous) && leadsInside(links_[blocker].next);
        }
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    }

    // Where no ear is left, the loop is degenerate or crosses itself: a corner without area costs least, then a convex
    // one.
    std::uint32_t leastBadCorner() const {
        const std::deque<std::uint32_t> corners = remaining();
        const auto flat = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) {
            return turn(points_[links_[i].previous], points_[i], points_[links_[i].next]) == 0;
        });
        if (flat != corners.end()) return *flat;
        const auto convex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) { return isConvex(i); });
        return convex != corners.end() ? *convex : corners.front();
    }

    void clip(std::uint32_t corner) {
        const std::uint32_t before = links_[corner].previous;
        const std::uint32_t after = links_[corner].next;
        out_.push_back({before, corner, after});
        links_[before].next = after;
        links_[after].previous = before;
        links_[corner].isGone = true;
        links_[corner].isBlocker = false;
        --left_;
        for (const std::uint32_t i : {before, after})
            links_[i].isBlocker = links_[i].isBlocker && !isConvex(i);
    }

    std::vector<glm::dvec2> points_;
    std::vector<Link> links_;
    std::optional<PointCells> cells_; ///< over the corners that were not convex at first: clipping makes none of them
    std::size_t left_;
    std::uint64_t work_ = 0; ///< corners that were looked at
    std::vector<PolygonTriangle>& out_;
};

} // namespace

void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<PolygonTriangle>& out) {
    GNOMON_CHECK_OP(corners.size(), >=, 3U);
    const auto n = static_cast<std::uint32_t>(corners.size());
    std::vector<glm::dvec2> loop = flatten(corners, newellNormal(corners));
    if (n > 3 && !isStrictlyConvex(loop)) return EarClipper(std::move(loop), out).run();
    for (std::uint32_t i = 2; i < n; ++i)
        out.push_back({0, i - 1, i});
}

} // namespace gnomon::read
