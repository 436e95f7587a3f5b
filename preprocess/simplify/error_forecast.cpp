#include "preprocess/simplify/error_forecast.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace gnomon::simplify {

using hierarchy::kNone;

ErrorForecast::ErrorForecast(const Patch& patch, LivingPatch& living) : patch_(patch), living_(living) {
    if (!patch.isBounded) return;
    stamp_.assign(patch.triangles.size(), 0);
    error_.reserve(patch.triangles.size());
    for (std::size_t t = 0; t < patch.triangles.size(); ++t)
        error_.push_back({patch.error(t).fromSource, patch.error(t).toSource});
}

void ErrorForecast::add(std::uint32_t triangle, double fromSource, double toSource) {
    outcomes_.push_back({triangle, fromSource, toSource});
    worst_ = std::max({worst_, fromSource, toSource});
}

/// Weighs the candidates that were gathered against `heir`: each has the largest squared distance of a corner of `t`
/// from it.
void ErrorForecast::weigh(const Triangle& t, Heir& heir) {
    proximity::TriangleRows::Row farthest{};
    proximity::TriangleRows::Row squares{};
    const std::span<const Candidate> candidates = std::span(candidates_).first(rows_.count());
    for (const std::uint32_t p : t) {
        const auto has = [&](const Candidate& candidate) {
            return candidate.corners[0] == p || candidate.corners[1] == p || candidate.corners[2] == p;
        };
        if (std::all_of(candidates.begin(), candidates.end(), has)) continue;
        rows_.nearestSquares(patch_.positions[p], squares);
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (!has(candidates[i])) farthest[i] = std::max(farthest[i], squares[i]);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Heir other{farthest[i], candidates[i].triangle};
        if (other.square < heir.square || (other.square == heir.square && other.triangle < heir.triangle)) heir = other;
    }
    rows_.clear();
}

/// The triangle among `t`'s new neighbours, or failing them near its piece, that has the source points of `t` nearest.
/// A convex set's distance is convex: where the corners of `t` are within it, so is all of `t`.
ErrorForecast::Heir ErrorForecast::heirOf(const Triangle& t, std::uint32_t from, std::uint32_t to) {
    Heir heir;
    const std::uint32_t stamp = ++stampNow_;
    const auto consider = [&](std::uint32_t candidate) {
        if (stamp_[candidate] == stamp) return;
        stamp_[candidate] = stamp;
        Triangle corners = living_.positions(candidate);
        std::replace(corners.begin(), corners.end(), from, to);
        if ((corners[0] == corners[1]) || (corners[1] == corners[2]) || (corners[2] == corners[0])) return;
        candidates_[rows_.count()] = {candidate, corners};
        rows_.add(patch_.positions[corners[0]], patch_.positions[corners[1]], patch_.positions[corners[2]]);
        if (rows_.isFull()) weigh(t, heir);
    };
    const auto considerAround = [&](std::uint32_t p) {
        living_.forCorners(p, [&](std::uint32_t corner) { consider(corner / 3); });
    };
    for (const std::uint32_t p : t)
        considerAround(p);
    weigh(t, heir);
    if (heir.triangle != kNone) return heir;
    for (const std::uint32_t p : t)
        if (const std::uint32_t q = living_.partner(p); q != kNone) considerAround(q);
    weigh(t, heir);
    return heir;
}

/// False if the star is no fan.
bool ErrorForecast::foreseeFan(CollapseStar& star) {
    if (!star.orderAsFan(fan_)) return false;
    const std::span<const StarFace> faces = star.faces();
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const BothErrors& before = error_[faces[i].triangle];
        fan_.fromSource[i] = before.fromSource;
        fan_.toSource[i] = before.toSource;
    }
    const FanAfter after = mapFan(fan_);
    for (std::uint32_t j = 1; j + 1 < fan_.count; ++j)
        add(faces[j].triangle, after.fromSource[j], after.toSource[j]);
    return true;
}

bool ErrorForecast::foresee(CollapseStar& star, double limit) {
    outcomes_.clear();
    worst_ = 0;
    if (foreseeFan(star)) return true;
    const glm::dvec3& origin = patch_.positions[star.from()];
    const glm::dvec3& target = patch_.positions[star.to()];
    for (const StarFace& face : star.faces()) {
        if (worst_ >= limit) return false;
        const BothErrors& before = error_[face.triangle];
        if (!star.vanishes(face)) {
            const glm::dvec3& b = patch_.positions[face.b];
            const glm::dvec3& c = patch_.positions[face.c];
            add(face.triangle,
                before.fromSource + std::sqrt(proximity::nearestSquare(origin, target, b, c)),
                before.toSource + std::sqrt(proximity::nearestSquare(target, origin, b, c)));
            continue;
        }
        const Heir heir = heirOf({star.from(), face.b, face.c}, star.from(), star.to());
        if (heir.triangle == kNone) return false;
        add(heir.triangle, before.fromSource + std::sqrt(heir.square), 0);
    }
    return true;
}

void ErrorForecast::take(const CollapseStar& star) {
    if (!patch_.isBounded) return;
    for (const StarFace& face : star.faces())
        if (!star.vanishes(face)) error_[face.triangle] = {};
    for (const Outcome& outcome : outcomes_) {
        BothErrors& error = error_[outcome.triangle];
        error.fromSource = std::max(error.fromSource, outcome.fromSource);
        error.toSource = std::max(error.toSource, outcome.toSource);
    }
}

void ErrorForecast::join(const LivingPatch::Doubled& pair) {
    if (!patch_.isBounded) return;
    BothErrors& kept = error_[pair.kept];
    const BothErrors& gone = error_[pair.gone];
    kept = {std::max(kept.fromSource, gone.fromSource), std::min(kept.toSource, gone.toSource)};
}

double ErrorForecast::around(std::uint32_t p) {
    if (!patch_.isBounded) return 0;
    double largest = 0;
    living_.forCorners(p, [&](std::uint32_t corner) {
        const BothErrors& error = error_[corner / 3];
        largest = std::max({largest, error.fromSource, error.toSource});
    });
    return largest;
}

} // namespace gnomon::simplify
