#include "preprocess/read/polygon.h"

#include "core/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

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

    /// Calls `test(index)` for every point that may lie in the triangle, until one call is true; whether one was.
    /// Adds the points and rows that it looked at to `work`.
    template <class Test>
    bool any(const std::array<glm::dvec2, 3>& triangle, std::uint64_t& work, Test test) const {
        const glm::dvec2 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
        const glm::dvec2 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
        for (std::size_t y = along(low, 1); y <= along(high, 1); ++y) {
            const std::size_t row = y * side_;
            const auto [first, last] = columnsOf(triangle, y, along(low, 0), along(high, 0));
            work += kWorkPerRow;
            for (std::uint32_t i = begins_[row + first]; i < begins_[row + last + 1]; ++i) {
                ++work;
                if (test(sorted_[i])) return true;
            }
        }
        return false;
    }

private:
    // The cells of row `y`, of those from `first` to `last`, that the triangle meets: what it needs of a long and
    // narrow box is little. Half a cell on all sides makes up for rounding.
    std::pair<std::size_t, std::size_t> columnsOf(
        const std::array<glm::dvec2, 3>& triangle, std::size_t y, std::size_t first, std::size_t last) const {
        if (last - first < kFewCells) return {first, last};
        const double bottom = static_cast<double>(y) - 0.5;
        const double top = static_cast<double>(y) + 1.5;
        double left = std::numeric_limits<double>::infinity();
        double right = -left;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2 a = (triangle[i] - min_) * scale_;
            const glm::dvec2 b = (triangle[(i + 1) % 3] - min_) * scale_;
            const glm::dvec2 way = b - a;
            if (!(std::abs(way.x) + std::abs(way.y) < kMostCells)) return {first, last}; // no numbers to reckon with
            const double toBottom = way.y != 0 ? std::clamp((bottom - a.y) / way.y, 0.0, 1.0) : 0;
            const double toTop = way.y != 0 ? std::clamp((top - a.y) / way.y, 0.0, 1.0) : 1;
            if (std::max(a.y, b.y) < bottom || std::min(a.y, b.y) > top) continue;
            left = std::min({left, a.x + toBottom * way.x, a.x + toTop * way.x});
            right = std::max({right, a.x + toBottom * way.x, a.x + toTop * way.x});
        }
        if (!(left <= right)) return {first, last};
        const auto cellAt = [&](double x) {
            return std::clamp(static_cast<std::size_t>(std::max(x, 0.0)), first, last);
        };
        return {cellAt(left - 0.5), cellAt(right + 0.5)};
    }

    // Never decreases with the coordinate; what is no number is in cell 0.
    std::size_t along(const glm::dvec2& point, int axis) const {
        const double cell = (point[axis] - min_[axis]) * scale_[axis];
        const auto last = static_cast<double>(side_ - 1);
        return cell > 0 ? static_cast<std::size_t>(std::min(cell, last)) : 0;
    }

    std::size_t cellOf(const glm::dvec2& point) const { return along(point, 1) * side_ + along(point, 0); }

    static constexpr std::size_t kFewCells = 4;
    static constexpr double kMostCells = 0x1p20;
    static constexpr std::uint64_t kWorkPerRow = 8; // as long as so many points take

    glm::dvec2 min_{std::numeric_limits<double>::infinity()};
    glm::dvec2 scale_{0};
    std::size_t side_ = 1;
    std::vector<std::uint32_t> begins_; ///< where a cell's points begin in sorted_; one more for the end
    std::vector<std::uint32_t> sorted_;
};

class EarClipper {
public:
    EarClipper(std::vector<glm::dvec2> loop, std::vector<PolygonTriangle>& out, Progress& progress)
        : points_(std::move(loop)),
          links_(points_.size()),
          left_(points_.size()),
          mostWork_(kMostWorkPerCorner * points_.size()),
          out_(out),
          progress_(progress) {
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
        while (left_ > 3 && work_ < mostWork_) {
            pollNowAndThen();
            if (candidates.empty()) {
                // Clipping can free corners far away, so all are asked again before the loop is taken for a bad one.
                if (!foundSinceScan) clipOfBadLoop();
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
    // Simple loops stay far below this.
    static constexpr std::uint64_t kMostWorkPerCorner = 10'000;

    // And this is what is left to a loop from where it turns out to have corners without area in its way, or to cross
    // itself: one that does so everywhere asks for a scan of all of it before each triangle, and none is right for it.
    static constexpr std::uint64_t kMostWorkPerFlatCorner = 1'000;
    static constexpr std::uint64_t kMostWorkPerCrossingCorner = 100;

    static constexpr std::uint64_t kWorkBetweenPolls = std::uint64_t{1} << 22U; // some milliseconds

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
        return !cells_->any(
            {a, b, c}, work_, [&](std::uint32_t blocker) { return links_[blocker].isBlocker && blocks(blocker, i); });
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

    void pollNowAndThen() {
        if (work_ < nextPoll_) return;
        nextPoll_ = work_ + kWorkBetweenPolls;
        progress_.advance(0);
    }

    // Where no ear is left, the loop is degenerate or crosses itself: a corner without area costs least, then a convex
    // one.
    void clipOfBadLoop() {
        const std::deque<std::uint32_t> corners = remaining();
        work_ += corners.size();
        const auto flat = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) {
            return turn(points_[links_[i].previous], points_[i], points_[links_[i].next]) == 0;
        });
        const bool isFlat = flat != corners.end();
        allowOnly(isFlat ? kMostWorkPerFlatCorner : kMostWorkPerCrossingCorner);
        if (isFlat) return clip(*flat);
        const auto convex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) { return isConvex(i); });
        clip(convex != corners.end() ? *convex : corners.front());
    }

    /// From where a loop turns out to be bad; a bound that holds already stays.
    void allowOnly(std::uint64_t workPerCorner) {
        if (workPerCorner >= workPerCorner_) return;
        workPerCorner_ = workPerCorner;
        mostWork_ = std::min(mostWork_, work_ + workPerCorner * points_.size());
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
    std::uint64_t mostWork_;
    std::uint64_t nextPoll_ = 0;
    std::uint64_t workPerCorner_ = kMostWorkPerCorner;
    std::vector<PolygonTriangle>& out_;
    Progress& progress_;
};

} // namespace

void triangulatePolygon(std::span<const glm::dvec3> corners, std::vector<PolygonTriangle>& out, Progress& progress) {
    GNOMON_CHECK_OP(corners.size(), >=, 3U);
    const auto n = static_cast<std::uint32_t>(corners.size());
    std::vector<glm::dvec2> loop = flatten(corners, newellNormal(corners));
    if (n > 3 && !isStrictlyConvex(loop)) return EarClipper(std::move(loop), out, progress).run();
    for (std::uint32_t i = 2; i < n; ++i)
        out.push_back({0, i - 1, i});
}

} // namespace gnomon::read
