#include "preprocess/read/polygon.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace gnomon::preprocess {

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

class EarClipper {
public:
    EarClipper(std::vector<glm::dvec2> loop, std::vector<PolygonTriangle>& out)
        : points_(std::move(loop)),
          next_(points_.size()),
          previous_(points_.size()),
          isGone_(points_.size(), false),
          left_(points_.size()),
          out_(out) {
        const auto n = static_cast<std::uint32_t>(points_.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i)
            if (!isConvex(i)) blockers_.push_back(i);
    }

    void run() {
        std::deque<std::uint32_t> candidates;
        bool foundSinceScan = true;
        while (left_ > 3) {
            if (candidates.empty()) {
                // Clipping can free corners far away, so all are asked again before the loop is taken for a bad one.
                if (!foundSinceScan) clip(leastBadCorner());
                candidates = remaining();
                foundSinceScan = false;
            }
            const std::uint32_t corner = candidates.front();
            candidates.pop_front();
            if (isGone_[corner] || !isEar(corner)) continue;
            candidates.push_back(previous_[corner]);
            candidates.push_back(next_[corner]);
            clip(corner);
            foundSinceScan = true;
        }
        const std::uint32_t last = remaining().front();
        out_.push_back({previous_[last], last, next_[last]});
    }

private:
    bool isConvex(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]) > 0; }

    std::deque<std::uint32_t> remaining() const {
        std::deque<std::uint32_t> result;
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            if (!isGone_[i]) result.push_back(i);
        return result;
    }

    // An ear: a convex corner whose triangle holds no other corner. Only corners that are not convex can be the first
    // to reach into it.
    bool isEar(std::uint32_t i) {
        if (!isConvex(i)) return false;
        for (const std::uint32_t blocker : blockers_)
            if (blocks(blocker, i)) return false;
        return true;
    }

    bool blocks(std::uint32_t blocker, std::uint32_t corner) const {
        const std::uint32_t before = previous_[corner];
        const std::uint32_t after = next_[corner];
        if (blocker == before || blocker == corner || blocker == after) return false;
        const glm::dvec2& a = points_[before];
        const glm::dvec2& b = points_[corner];
        const glm::dvec2& c = points_[after];
        const glm::dvec2& p = points_[blocker];
        // Loops with holes touch themselves along bridges: a twin of an end blocks nothing, a twin of the tip blocks if
        // its own edges lead into the triangle.
        if (p == a || p == c) return false;
        if (p == b) {
            const auto leadsInside = [&](std::uint32_t other) {
                return turn(a, b, points_[other]) > 0 && turn(b, c, points_[other]) > 0;
            };
            return leadsInside(previous_[blocker]) || leadsInside(next_[blocker]);
        }
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    }

    // Where no ear is left, the loop is degenerate or crosses itself: a corner without area costs least, then a convex
    // one.
    std::uint32_t leastBadCorner() const {
        const std::deque<std::uint32_t> corners = remaining();
        const auto flat = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) {
            return turn(points_[previous_[i]], points_[i], points_[next_[i]]) == 0;
        });
        if (flat != corners.end()) return *flat;
        const auto convex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t i) { return isConvex(i); });
        return convex != corners.end() ? *convex : corners.front();
    }

    void clip(std::uint32_t corner) {
        const std::uint32_t before = previous_[corner];
        const std::uint32_t after = next_[corner];
        out_.push_back({before, corner, after});
        next_[before] = after;
        previous_[after] = before;
        isGone_[corner] = true;
        --left_;
        std::erase_if(
            blockers_, [&](std::uint32_t i) { return i == corner || ((i == before || i == after) && isConvex(i)); });
    }

    std::vector<glm::dvec2> points_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<bool> isGone_;
    std::vector<std::uint32_t> blockers_; ///< corners that are not convex
    std::size_t left_;
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

} // namespace gnomon::preprocess
