// The quadric simplifier: half-edge collapses in the order of their cost (Garland, Heckbert, "Surface Simplification
// Using Quadric Error Metrics", 1997).
//
// - A vertex moves onto a neighbour (half-edge collapse) or onto the nearest vertex of another connected component (the
//   non-edge vertex pairs of the same paper). There are therefore no new positions, and all positions are on the grid.
//   Locked positions, which other groups share, do not move. Edges between two locked positions keep their triangles.
// - The cost estimate is the root of the mean squared distance of the target from the planes of the source's triangles.
//   The planes form a quadric, weighted by area and summed over collapses, so that each vertex has the planes of all
//   vertices that it replaced. Open edges and attribute seams add perpendicular planes. Small terms add the edge length
//   and the change of normal and colour.
// - The final cost is an upper bound of the error after the collapse, if that is larger than the estimate. A piecewise
//   linear map between the star before and after computes the bound (Cohen, Manocha, Olano, "Simplifying Polygonal
//   Models Using Successive Mappings", 1997; fan_map.h). If the star is not a fan, distances to convex sets compute the
//   bound (collapse_error_bound.h).
// - A collapse that turns a normal by more than 75 degrees is rejected. A collapse that changes the topology costs
//   twice. The test is the link condition (Dey, Edelsbrunner, Guha, Nekhayev, "Topology Preserving Edge Contraction",
//   1999).
// - The queue is lazy: it stores estimates, and only the first vertex is evaluated. If its cost is higher than its
//   estimate, it returns to the queue. A collapse above the patch's cost limit is rejected. The loop stops early if
//   less than two thirds of the triangles are left and the cost rises steeply.
#include "preprocess/simplify/collapse_error_bound.h"
#include "preprocess/simplify/collapse_queue.h"
#include "preprocess/simplify/collapse_star.h"
#include "preprocess/simplify/cost_estimate.h"
#include "preprocess/simplify/layer_gaps.h"
#include "preprocess/simplify/simplification_mesh.h"
#include "preprocess/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::simplify {

namespace {

using hierarchy::kNone;

constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr double kTopologyPenalty = 2;   // factor of the cost of a collapse that violates the link condition
constexpr double kQueueSlack = 1.1;      // max ratio of the evaluated cost to the cost in the queue
constexpr double kEarlyStopShare = 0.67; // rising costs may stop the loop only below this share of the triangles
// Max ratio of the next cost to the largest accepted cost. Above this ratio the loop stops.
constexpr double kMaxCostRise = 1.6;
constexpr double kMeanEdges = 2.5; // the cost limit of CostLimit::MeanEdge, in mean edge lengths of the patch

double meanEdge(const Patch& patch) {
    double length = 0;
    for (const Triangle& t : patch.triangles) {
        const Triangle p = patch.corners(t);
        for (std::size_t i = 0; i < 3; ++i)
            length += glm::distance(patch.positions[p[i]], patch.positions[p[(i + 1) % 3]]);
    }
    return length / (3.0 * static_cast<double>(patch.triangles.size()));
}

/// Simplifies one patch with a queue of edge collapses, cheapest first. Costs are distances in grid steps.
class Collapser {
public:
    explicit Collapser(const Patch& patch);
    SimplifiedPatch run(std::size_t targetTriangles);

private:
    struct Choice {
        double cost = kForbidden;
        std::uint32_t target = kNone;
    };

    template <class Visit>
    void forTargets(std::uint32_t p, std::span<const std::uint32_t> neighbours, Visit visit);
    double boundedCost(std::uint32_t from, std::uint32_t to, double limit = kForbidden);
    double layerCost() const;
    Choice cheapestByEstimate(std::uint32_t p, std::span<const std::uint32_t> neighbours);
    Choice cheapestByBound(std::uint32_t p, Choice best);

    void refresh(std::uint32_t p) { refresh(p, mesh_.neighbours(p)); }

    void refresh(std::uint32_t p, std::span<const std::uint32_t> neighbours);
    void refreshAround(std::uint32_t from, std::uint32_t to);
    void reinsert(std::uint32_t p, const Choice& choice);
    std::optional<Choice> evaluateFirst(std::uint32_t p, double cost);
    void collapse(std::uint32_t from, std::uint32_t to);
    void removeDuplicates(std::uint32_t p);
    void redirectIsolated(std::uint32_t p);
    SimplifiedPatch result() const;

    const Patch& patch_;
    SimplificationMesh mesh_;
    CostEstimate estimate_;
    CollapseErrorBound errors_;
    std::vector<LayerGap> gaps_; // per triangle: distance to a layer of another colour; empty without layers
    CollapseStar star_;          // the triangles around the collapse that `boundedCost` evaluated last
    double maxCost_;             // max cost of a collapse
    double estimated_ = 0;
    double layerCharge_ = 0;
    CollapseQueue queue_;
    std::vector<std::uint32_t> target_;   // per position in the queue: the position that it would collapse onto
    std::vector<std::uint8_t> isBounded_; // per position in the queue: 1 if its cost is a bound, 0 if an estimate
    std::vector<std::uint32_t> around_;   // neighbours of the removed position in the current collapse
    std::vector<std::pair<double, std::uint32_t>> candidates_;
};

Collapser::Collapser(const Patch& patch)
    : patch_(patch),
      mesh_(patch),
      estimate_(patch, mesh_),
      errors_(patch, mesh_),
      gaps_(layerGaps(patch)),
      star_(patch, mesh_),
      maxCost_(patch.costLimit == CostLimit::None ? kForbidden : kMeanEdges * meanEdge(patch)),
      queue_(patch.positions.size()),
      target_(patch.positions.size(), kNone),
      isBounded_(patch.positions.size(), 0) {}

/// Calls `visit(q, square)` for each position q onto which `p` may collapse. `square` is the squared cost estimate. The
/// positions are the `neighbours` of `p` and the partner in its vertex pair (a nearby position of another component).
template <class Visit>
void Collapser::forTargets(std::uint32_t p, std::span<const std::uint32_t> neighbours, Visit visit) {
    const std::span<const double> squares = estimate_.squares(p, neighbours);
    for (std::size_t i = 0; i < neighbours.size(); ++i)
        visit(neighbours[i], squares[i]);
    const std::uint32_t q = mesh_.pairedWith(p);
    if (q != kNone && q != p && mesh_.hasTriangles(q))
        visit(q, estimate_.square(p, q) * kTopologyPenalty * kTopologyPenalty);
}

/// Returns the cost of a collapse of position `from` onto position `to`, including the error bound. Returns kForbidden
/// if the collapse is not allowed or if its cost reaches `limit`.
double Collapser::boundedCost(std::uint32_t from, std::uint32_t to, double limit) {
    star_.gather(from, to);
    if (star_.vanishingCount() >= mesh_.triangleCount()) return kForbidden; // at least one triangle must remain
    if (star_.turnsFace() || star_.breaksLockedEdge()) return kForbidden;
    const double penalty = star_.violatesLinkCondition() ? kTopologyPenalty : 1;
    const double estimate = std::sqrt(estimate_.square(from, to));
    if (!patch_.isErrorBounded) return penalty * estimate;
    if (!errors_.evaluate(star_, limit)) return kForbidden;
    const double before = errors_.largestAround(from);
    const double cost = std::max(errors_.worst(), before + estimate) + (penalty - 1) * (errors_.worst() - before);
    return std::max(cost, layerCost());
}

/// Returns the max cost of moving faces of `star_` to the other side of a layer, a nearby face of another colour
/// (layer_gaps.h).
double Collapser::layerCost() const {
    if (gaps_.empty()) return 0;
    double cost = 0;
    for (const StarFace& face : star_.faces()) {
        const LayerGap& gap = gaps_[face.triangle];
        if (star_.vanishes(face) || gap.charge <= cost) continue;
        const glm::dvec3& normal = mesh_.originalNormal(face.triangle);
        const std::uint32_t corner = patch_.positionOf[patch_.triangles[face.triangle][0]];
        const glm::dvec3 moved = patch_.positions[star_.to()] - patch_.positions[corner];
        if (std::abs(glm::dot(moved, normal)) > double{gap.reach} * glm::length(normal)) cost = gap.charge;
    }
    return cost;
}

/// Returns the collapse target of `p` with the lowest cost estimate.
Collapser::Choice Collapser::cheapestByEstimate(std::uint32_t p, std::span<const std::uint32_t> neighbours) {
    Choice best;
    forTargets(p, neighbours, [&](std::uint32_t q, double cost) {
        if (cost < best.cost || (cost == best.cost && q < best.target)) best = {cost, q};
    });
    if (best.target != kNone) best.cost = errors_.largestAround(p) + std::sqrt(best.cost);
    return best;
}

/// Returns the collapse target of `p` with the lowest cost, including error bounds. `best` is a target whose bounded
/// cost is known.
Collapser::Choice Collapser::cheapestByBound(std::uint32_t p, Choice best) {
    candidates_.clear();
    forTargets(p, mesh_.neighbours(p), [&](std::uint32_t q, double cost) { candidates_.emplace_back(cost, q); });
    std::sort(candidates_.begin(), candidates_.end());
    const double before = errors_.largestAround(p);
    const std::uint32_t first = best.target;
    if (best.cost == kForbidden) best.target = kNone;
    for (const auto& [cost, q] : candidates_) {
        if (before + std::sqrt(cost) >= best.cost) break;
        if (q == first) continue;
        const double allowed = boundedCost(p, q, best.cost);
        if (allowed < best.cost) best = {allowed, q};
    }
    return best;
}

/// Inserts position `p` into the queue with its current cost estimate. `neighbours` are the neighbours of `p`.
void Collapser::refresh(std::uint32_t p, std::span<const std::uint32_t> neighbours) {
    if (patch_.isLocked[p] != 0) return;
    const Choice choice = cheapestByEstimate(p, neighbours);
    isBounded_[p] = 0;
    target_[p] = choice.target;
    if (choice.target == kNone)
        queue_.remove(p);
    else
        queue_.put(p, choice.cost);
}

/// Updates the costs in the queue after a collapse of position `from` onto position `to`.
void Collapser::refreshAround(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t q : around_) {
        if (!mesh_.isRepresentative(q) || patch_.isLocked[q] != 0) continue;
        if (target_[q] == from || isBounded_[q] != 0 || !queue_.contains(q)) {
            refresh(q);
            continue;
        }
        const double estimate = std::sqrt(estimate_.square(q, to));
        if (estimate >= queue_.costOf(q)) continue; // this is true in most cases, and errors cannot lower the cost
        const double cost = errors_.largestAround(q) + estimate;
        if (cost >= queue_.costOf(q)) continue;
        target_[q] = to;
        queue_.put(q, cost);
    }
    const std::span<const std::uint32_t> neighbours = mesh_.neighbours(to);
    around_.clear();
    for (const std::uint32_t q : neighbours)
        if (!queue_.contains(q) && patch_.isLocked[q] == 0)
            around_.push_back(q); // no collapse of q was allowed before, but one may be allowed now
    if (mesh_.isRepresentative(to)) refresh(to, neighbours);
    for (const std::uint32_t q : around_)
        refresh(q);
}

/// Inserts position `p` into the queue again with the cost of `choice`, if a collapse is allowed.
void Collapser::reinsert(std::uint32_t p, const Choice& choice) {
    if (choice.target == kNone) return;
    target_[p] = choice.target;
    isBounded_[p] = 1;
    queue_.put(p, choice.cost);
}

/// Computes the cost of position `p`, including its error bound. `p` was first in the queue with the cost `cost`. If
/// the new cost is higher, the function inserts `p` into the queue again and returns nullopt.
std::optional<Collapser::Choice> Collapser::evaluateFirst(std::uint32_t p, double cost) {
    if (!mesh_.hasTriangles(p)) return std::nullopt;
    const std::uint32_t to = target_[p];
    if (!mesh_.hasTriangles(to)) { // `to` has lost all of its triangles since the estimate
        refresh(p);
        return std::nullopt;
    }
    const Choice found{boundedCost(p, to), to};
    if (!(found.cost <= kQueueSlack * cost)) {
        reinsert(p, cheapestByBound(p, found));
        return std::nullopt;
    }
    if (found.cost > maxCost_) {
        reinsert(p, found);
        return std::nullopt;
    }
    return found;
}

/// Applies the collapse of position `from` onto position `to`, which `boundedCost` evaluated last.
void Collapser::collapse(std::uint32_t from, std::uint32_t to) {
    estimated_ = std::max(estimated_, estimate_.planes(from, to));
    layerCharge_ = std::max(layerCharge_, layerCost());
    around_.clear();
    for (const std::uint32_t q : mesh_.neighbours(from))
        if (q != to) around_.push_back(q);
    errors_.commit(star_);
    star_.apply();
    mesh_.merge(from, to);
    estimate_.merge(from, to);
    removeDuplicates(to);
    for (const StarFace& face : star_.faces())
        if (star_.vanishes(face)) redirectIsolated(face.b == to ? face.c : face.b);
    redirectIsolated(to);
    refreshAround(from, to);
}

/// Removes triangles at position `p` that have the same three corner positions as an earlier triangle.
void Collapser::removeDuplicates(std::uint32_t p) {
    for (const SimplificationMesh::Duplicate& pair : mesh_.duplicates(p)) {
        errors_.merge(pair);
        mesh_.remove(pair.removed);
    }
}

/// Redirects position `p` to another position if no triangle remains at `p`. The new position is the nearest corner of
/// the triangles that received the errors of the removed triangles.
void Collapser::redirectIsolated(std::uint32_t p) {
    if (mesh_.hasTriangles(p)) return;
    queue_.remove(p);
    double best = kForbidden;
    for (const CollapseErrorBound::Outcome& outcome : errors_.outcomes()) {
        if (mesh_.isRemoved(outcome.triangle)) continue;
        for (const std::uint32_t q : mesh_.positions(outcome.triangle)) {
            const double square = proximity::squaredLength(patch_.positions[q] - patch_.positions[p]);
            if (square >= best) continue;
            best = square;
            mesh_.redirect(p, q);
        }
    }
}

SimplifiedPatch Collapser::run(std::size_t targetTriangles) {
    std::vector<double> costs(patch_.positions.size(), kForbidden);
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p) {
        if (patch_.isLocked[p] != 0) continue;
        const Choice choice = cheapestByEstimate(p, mesh_.neighbours(p));
        target_[p] = choice.target;
        costs[p] = choice.cost;
    }
    queue_.putAll(costs);
    const double earlyStopCount = kEarlyStopShare * static_cast<double>(mesh_.triangleCount());
    double maxAcceptedCost = 0; // costs up to this value do not stop the loop
    while (mesh_.triangleCount() > targetTriangles && !queue_.isEmpty()) {
        const bool mayStopEarly = static_cast<double>(mesh_.triangleCount()) < earlyStopCount;
        const double cost = queue_.minCost();
        if (cost > maxCost_ || (mayStopEarly && cost > kMaxCostRise * maxAcceptedCost)) break;
        const std::uint32_t p = queue_.pop();
        const std::optional<Choice> choice = evaluateFirst(p, cost);
        if (!choice) continue;
        if (!mayStopEarly) maxAcceptedCost = std::max(maxAcceptedCost, choice->cost);
        collapse(p, choice->target);
    }
    return result();
}

SimplifiedPatch Collapser::result() const {
    SimplifiedPatch result;
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) {
        if (mesh_.isRemoved(t)) continue;
        result.triangles.push_back(mesh_.vertices(t));
        result.origin.push_back(t);
        if (patch_.isErrorBounded) result.errors.push_back(errors_.of(t));
    }
    result.movedTo.reserve(patch_.positions.size());
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p)
        result.movedTo.push_back(mesh_.representative(p));
    result.estimatedError = std::sqrt(estimated_);
    result.layerCharge = layerCharge_;
    return result;
}

} // namespace

SimplifiedPatch simplifyQuadric(const Patch& patch, std::size_t targetTriangles) {
    return Collapser(patch).run(std::max<std::size_t>(targetTriangles, 1));
}

} // namespace gnomon::simplify
