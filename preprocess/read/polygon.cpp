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

// Returns twice the signed area of the 2D triangle a, b, c. The result is positive for a left turn.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Returns Newell's normal of the closed polygon `corners` (Sutherland, Sproull, Schumacker 1974). Each component is
// twice the area of the polygon's projection along that axis.
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

// Projects the polygon to 2D along the axis nearest to `normal`. The projected polygon has a positive area.
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

/// A k-d tree that finds the points inside a triangle. Points can be removed. A query is fast because a long and narrow
/// triangle intersects few boxes of the tree.
class PointTree {
public:
    PointTree(std::span<const glm::dvec2> points, std::vector<std::uint32_t> indices)
        : points_(points), sorted_(std::move(indices)), placeOf_(points.size()) {
        if (!sorted_.empty()) build(0, static_cast<std::uint32_t>(sorted_.size()));
        for (std::uint32_t place = 0; place < sorted_.size(); ++place)
            placeOf_[sorted_[place]] = place;
    }

    /// Calls `test(index)` for each point that may be in the triangle, until a call returns true. Returns true if a
    /// call returned true. The triangle's corners must be in counter-clockwise order. Adds the number of visited boxes
    /// and points to `work`.
    template <class Test>
    bool any(const std::array<glm::dvec2, 3>& triangle, std::uint64_t& work, Test test) {
        if (nodes_.empty()) return false;
        stack_.assign(1, 0);
        while (!stack_.empty()) {
            const Node& node = nodes_[stack_.back()];
            stack_.pop_back();
            ++work;
            if (node.left == 0 || isApart(node, triangle)) continue;
            if (node.child != 0) {
                stack_.push_back(node.child);
                stack_.push_back(node.child + 1);
                continue;
            }
            for (std::uint32_t place = node.begin; place < node.end; ++place) {
                ++work;
                if (test(sorted_[place])) return true;
            }
        }
        return false;
    }

    /// Removes a point that is in the tree.
    void remove(std::uint32_t index) {
        std::uint32_t node = 0;
        while (true) {
            --nodes_[node].left;
            const std::uint32_t child = nodes_[node].child;
            if (child == 0) return;
            node = placeOf_[index] < nodes_[child].end ? child : child + 1;
        }
    }

private:
    struct Node {
        glm::dvec2 min{std::numeric_limits<double>::infinity()};
        glm::dvec2 max{-std::numeric_limits<double>::infinity()};
        std::uint32_t begin = 0; ///< first of the node's points in sorted_
        std::uint32_t end = 0;
        std::uint32_t left = 0;  ///< number of the node's points that are not removed
        std::uint32_t child = 0; ///< index of the first of two children; 0 for a leaf
    };

    static constexpr std::uint32_t kLeafPoints = 8;

    /// Returns true if the box of `node` is outside the triangle: if it does not intersect the triangle's bounding box,
    /// or if it is on the outer side of an edge. For each edge, the test uses the box corner with the largest `turn`.
    /// Rounding is monotone, so no point in the box has a larger `turn`.
    static bool isApart(const Node& node, const std::array<glm::dvec2, 3>& triangle) {
        const glm::dvec2 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
        const glm::dvec2 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
        if (node.max.x < low.x || node.max.y < low.y || node.min.x > high.x || node.min.y > high.y) return true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2& a = triangle[i];
            const glm::dvec2& b = triangle[(i + 1) % 3];
            const glm::dvec2 inner(b.y > a.y ? node.min.x : node.max.x, b.x > a.x ? node.max.y : node.min.y);
            if (turn(a, b, inner) < 0) return true;
        }
        return false;
    }

    std::uint32_t addNode(std::uint32_t begin, std::uint32_t end) {
        Node node;
        for (std::uint32_t place = begin; place < end; ++place) {
            node.min = glm::min(node.min, points_[sorted_[place]]);
            node.max = glm::max(node.max, points_[sorted_[place]]);
        }
        node.begin = begin;
        node.end = end;
        node.left = end - begin;
        nodes_.push_back(node);
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    void build(std::uint32_t begin, std::uint32_t end) {
        addNode(begin, end);
        std::uint32_t next = 0;
        while (next < nodes_.size()) // the loop also visits nodes that a split appends
            split(next++);
    }

    void split(std::uint32_t number) {
        const Node node = nodes_[number];
        if (node.left <= kLeafPoints) return;
        const glm::dvec2 size = node.max - node.min;
        const int axis = size.x >= size.y ? 0 : 1;
        const auto key = [&](std::uint32_t index) {
            const double value = points_[index][axis];
            return value == value ? value : -std::numeric_limits<double>::infinity();
        };
        const std::uint32_t middle = node.begin + node.left / 2;
        std::nth_element(
            sorted_.begin() + node.begin,
            sorted_.begin() + middle,
            sorted_.begin() + node.end,
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        const std::uint32_t child = addNode(node.begin, middle);
        addNode(middle, node.end);
        nodes_[number].child = child;
    }

    std::span<const glm::dvec2> points_;
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint32_t> placeOf_; ///< position in sorted_ per point
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> stack_;
};

class EarClipper {
public:
    EarClipper(std::vector<glm::dvec2> loop, std::vector<PolygonTriangle>& out, Progress& progress)
        : points_(std::move(loop)),
          links_(points_.size()),
          left_(points_.size()),
          maxWork_(kMaxWorkPerCorner * points_.size()),
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
        blockers_.emplace(points_, std::move(blockers));
    }

    void run() {
        std::deque<std::uint32_t> candidates;
        bool foundSinceScan = true;
        while (left_ > 3 && work_ < maxWork_) {
            pollNowAndThen();
            if (candidates.empty()) {
                // Clipping can turn distant corners into ears. All remaining corners are therefore tested again before
                // the polygon counts as degenerate.
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
    // Max steps of ear clipping per corner. Polygons without crossings need less: a star of a million spikes with
    // random lengths needs less than half of this.
    static constexpr std::uint64_t kMaxWorkPerCorner = 2'000;

    // Max further steps per corner for a polygon with corners without area, and for a polygon with crossings. A polygon
    // that crosses itself everywhere needs a scan of all corners per triangle, and none of its triangulations is
    // correct.
    static constexpr std::uint64_t kMaxWorkPerFlatCorner = 1'000;
    static constexpr std::uint64_t kMaxWorkPerCrossingCorner = 100;

    static constexpr std::uint64_t kWorkBetweenPolls = std::uint64_t{1} << 22U; // a few milliseconds

    struct Link {
        std::uint32_t previous;
        std::uint32_t next;
        bool isGone;
        bool isBlocker; ///< whether the corner is not convex and can thus prevent ears
    };

    bool isConvex(std::uint32_t i) const {
        return turn(points_[links_[i].previous], points_[i], points_[links_[i].next]) > 0;
    }

    /// Returns the corners that are not clipped yet, in the polygon's order.
    std::deque<std::uint32_t> remaining() {
        while (links_[first_].isGone)
            ++first_;
        std::deque<std::uint32_t> result;
        std::uint32_t corner = first_;
        do {
            result.push_back(corner);
            corner = links_[corner].next;
        } while (corner != first_);
        return result;
    }

    // Returns true if corner `i` is an ear: a convex corner whose triangle contains no other corner. The test checks
    // only non-convex corners, because if any corner is in the triangle, a non-convex corner is too.
    bool isEar(std::uint32_t i) {
        if (!isConvex(i)) return false;
        const glm::dvec2& a = points_[links_[i].previous];
        const glm::dvec2& b = points_[i];
        const glm::dvec2& c = points_[links_[i].next];
        return !blockers_->any(
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
        // A polygon can touch itself, for example at a bridge to a hole. A corner at the position of a neighbour of the
        // ear does not block the ear. A corner at the position of the ear's tip blocks the ear if it is a notch that
        // opens into the ear.
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

    // Clips one corner of a polygon that has no ears because it is degenerate or crosses itself. The function prefers a
    // corner without area, and then a convex corner.
    void clipOfBadLoop() {
        const std::deque<std::uint32_t> corners = remaining();
        work_ += corners.size();
        const auto flat = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) {
            return turn(points_[links_[i].previous], points_[i], points_[links_[i].next]) == 0;
        });
        const bool isFlat = flat != corners.end();
        allowOnly(isFlat ? kMaxWorkPerFlatCorner : kMaxWorkPerCrossingCorner);
        if (isFlat) return clip(*flat);
        const auto convex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) { return isConvex(i); });
        clip(convex != corners.end() ? *convex : corners.front());
    }

    /// Lowers the limit of steps for the rest of a degenerate polygon. It never raises the limit.
    void allowOnly(std::uint64_t workPerCorner) {
        if (workPerCorner >= workPerCorner_) return;
        workPerCorner_ = workPerCorner;
        maxWork_ = std::min(maxWork_, work_ + workPerCorner * points_.size());
    }

    void clip(std::uint32_t corner) {
        const std::uint32_t before = links_[corner].previous;
        const std::uint32_t after = links_[corner].next;
        out_.push_back({before, corner, after});
        links_[before].next = after;
        links_[after].previous = before;
        links_[corner].isGone = true;
        --left_;
        if (links_[corner].isBlocker) unblock(corner);
        for (const std::uint32_t i : {before, after})
            if (links_[i].isBlocker && isConvex(i)) unblock(i);
    }

    void unblock(std::uint32_t corner) {
        links_[corner].isBlocker = false;
        blockers_->remove(corner);
    }

    std::vector<glm::dvec2> points_;
    std::vector<Link> links_;
    std::optional<PointTree> blockers_; ///< the corners that are not convex; clipping never adds such corners
    std::size_t left_;
    std::uint32_t first_ = 0; ///< all corners before this index are clipped
    std::uint64_t work_ = 0;  ///< number of visited corners and boxes
    std::uint64_t maxWork_;
    std::uint64_t nextPoll_ = 0;
    std::uint64_t workPerCorner_ = kMaxWorkPerCorner;
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
