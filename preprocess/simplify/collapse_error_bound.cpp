#include "preprocess/simplify/collapse_error_bound.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace gnomon::simplify {

using hierarchy::kNone;

CollapseErrorBound::CollapseErrorBound(const Patch& patch, SimplificationMesh& mesh) : patch_(patch), mesh_(mesh) {
    if (!patch.isErrorBounded) return;
    stamp_.assign(patch.triangles.size(), 0);
    error_.reserve(patch.triangles.size());
    for (std::size_t t = 0; t < patch.triangles.size(); ++t)
        error_.push_back({patch.error(t).fromSource, patch.error(t).toSource});
}

void CollapseErrorBound::add(std::uint32_t triangle, double fromSource, double toSource) {
    outcomes_.push_back({triangle, fromSource, toSource});
    worst_ = std::max({worst_, fromSource, toSource});
}

/// Compares the candidate triangles with the best candidate so far, `receiver`. The best candidate has the smallest max
/// distance from a corner of `t`.
void CollapseErrorBound::compareCandidates(const Triangle& t, Receiver& receiver) {
    proximity::TriangleBatch::Row farthest{};
    proximity::TriangleBatch::Row squares{};
    const std::span<const Candidate> candidates = std::span(candidates_).first(batch_.count());
    for (const std::uint32_t p : t) {
        const auto has = [&](const Candidate& candidate) {
            return candidate.corners[0] == p || candidate.corners[1] == p || candidate.corners[2] == p;
        };
        if (std::all_of(candidates.begin(), candidates.end(), has)) continue;
        batch_.squaredDistances(patch_.positions[p], squares);
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (!has(candidates[i])) farthest[i] = std::max(farthest[i], squares[i]);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Receiver other{farthest[i], candidates[i].triangle};
        if (other.square < receiver.square || (other.square == receiver.square && other.triangle < receiver.triangle))
            receiver = other;
    }
    batch_.clear();
}

/// Returns the triangle that receives the source points of the removed triangle `t`, which is the triangle nearest to
/// all of `t`. The candidates are the neighbours of `t` after the collapse. If there are none, the candidates are the
/// triangles around the vertex pairs of its corners. The distance to a convex set is a convex function, so the max
/// distance of a corner of `t` bounds the distance of each point of `t`.
CollapseErrorBound::Receiver CollapseErrorBound::receiverOf(const Triangle& t, std::uint32_t from, std::uint32_t to) {
    Receiver receiver;
    const std::uint32_t stamp = ++stampNow_;
    const auto addCandidate = [&](std::uint32_t candidate) {
        if (stamp_[candidate] == stamp) return;
        stamp_[candidate] = stamp;
        Triangle corners = mesh_.positions(candidate);
        std::replace(corners.begin(), corners.end(), from, to);
        if ((corners[0] == corners[1]) || (corners[1] == corners[2]) || (corners[2] == corners[0])) return;
        candidates_[batch_.count()] = {candidate, corners};
        batch_.add(patch_.positions[corners[0]], patch_.positions[corners[1]], patch_.positions[corners[2]]);
        if (batch_.isFull()) compareCandidates(t, receiver);
    };
    const auto addCandidatesAround = [&](std::uint32_t p) {
        mesh_.forEachCorner(p, [&](std::uint32_t corner) { addCandidate(corner / 3); });
    };
    for (const std::uint32_t p : t)
        addCandidatesAround(p);
    compareCandidates(t, receiver);
    if (receiver.triangle != kNone) return receiver;
    for (const std::uint32_t p : t)
        if (const std::uint32_t q = mesh_.pairedWith(p); q != kNone) addCandidatesAround(q);
    compareCandidates(t, receiver);
    return receiver;
}

/// Computes the errors after the collapse with a piecewise linear map between triangle fans (mapFan). Returns false if
/// the triangles of the star are not a fan.
bool CollapseErrorBound::evaluateFan(CollapseStar& star) {
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

bool CollapseErrorBound::evaluate(CollapseStar& star, double limit) {
    outcomes_.clear();
    worst_ = 0;
    if (evaluateFan(star)) return true;
    const glm::dvec3& origin = patch_.positions[star.from()];
    const glm::dvec3& target = patch_.positions[star.to()];
    for (const StarFace& face : star.faces()) {
        if (worst_ >= limit) return false;
        const BothErrors& before = error_[face.triangle];
        if (!star.vanishes(face)) {
            const glm::dvec3& b = patch_.positions[face.b];
            const glm::dvec3& c = patch_.positions[face.c];
            add(face.triangle,
                before.fromSource + std::sqrt(proximity::squaredDistance(origin, target, b, c)),
                before.toSource + std::sqrt(proximity::squaredDistance(target, origin, b, c)));
            continue;
        }
        const Receiver receiver = receiverOf({star.from(), face.b, face.c}, star.from(), star.to());
        if (receiver.triangle == kNone) return false;
        add(receiver.triangle, before.fromSource + std::sqrt(receiver.square), 0);
    }
    return true;
}

void CollapseErrorBound::commit(const CollapseStar& star) {
    if (!patch_.isErrorBounded) return;
    for (const StarFace& face : star.faces())
        if (!star.vanishes(face)) error_[face.triangle] = {};
    for (const Outcome& outcome : outcomes_) {
        BothErrors& error = error_[outcome.triangle];
        error.fromSource = std::max(error.fromSource, outcome.fromSource);
        error.toSource = std::max(error.toSource, outcome.toSource);
    }
}

void CollapseErrorBound::merge(const SimplificationMesh::Duplicate& pair) {
    if (!patch_.isErrorBounded) return;
    BothErrors& kept = error_[pair.kept];
    const BothErrors& removed = error_[pair.removed];
    kept = {std::max(kept.fromSource, removed.fromSource), std::min(kept.toSource, removed.toSource)};
}

double CollapseErrorBound::largestAround(std::uint32_t p) {
    if (!patch_.isErrorBounded) return 0;
    double largest = 0;
    mesh_.forEachCorner(p, [&](std::uint32_t corner) {
        const BothErrors& error = error_[corner / 3];
        largest = std::max({largest, error.fromSource, error.toSource});
    });
    return largest;
}

} // namespace gnomon::simplify
