#include "preprocess/simplify/collapse_queue.h"
#include "preprocess/simplify/collapse_star.h"
#include "preprocess/simplify/cost_estimate.h"
#include "preprocess/simplify/error_forecast.h"
#include "preprocess/simplify/living_patch.h"
#include "preprocess/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::simplify {

namespace {

using hierarchy::kNone;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kTopologyPenalty = 2; // a change of topology must be half as far
constexpr double kSlack = 1.1;         // a collapse may cost so much more than its turn in the queue says
constexpr double kEnoughShare = 0.67;  // of the triangles: with so few left, a patch need not get fewer at any price
constexpr double kMostRise = 1.6;      // by how much the cost may rise from there
constexpr double kFairEdges = 2.5;     // mean edges of a patch: what a collapse may cost at a fair price

double meanEdge(const Patch& patch) {
    double length = 0;
    for (const Triangle& t : patch.triangles) {
        const Triangle p = patch.corners(t);
        for (std::size_t i = 0; i < 3; ++i)
            length += glm::distance(patch.positions[p[i]], patch.positions[p[(i + 1) % 3]]);
    }
    return length / (3.0 * static_cast<double>(patch.triangles.size()));
}

/// One simplification: who collapses next, and onto whom. Costs are distances in grid steps.
class Collapser {
public:
    explicit Collapser(const Patch& patch);
    SimplifiedPatch run(std::size_t targetTriangles);

private:
    struct Choice {
        double cost = kNever;
        std::uint32_t target = kNone;
    };

    template <class Visit>
    void forTargets(std::uint32_t p, std::span<const std::uint32_t> neighbours, Visit visit);
    double trueCost(std::uint32_t from, std::uint32_t to, double limit = kNever);
    Choice cheapest(std::uint32_t p, std::span<const std::uint32_t> neighbours);
    Choice cheapestAllowed(std::uint32_t p, Choice best);

    void refresh(std::uint32_t p) { refresh(p, living_.neighbours(p)); }

    void refresh(std::uint32_t p, std::span<const std::uint32_t> neighbours);
    void refreshAround(std::uint32_t from, std::uint32_t to);
    void putBack(std::uint32_t p, const Choice& choice);
    std::optional<Choice> inItsTurn(std::uint32_t p, double cost);
    void collapse(std::uint32_t from, std::uint32_t to);
    void removeDoubled(std::uint32_t p);
    void leave(std::uint32_t p);
    SimplifiedPatch result() const;

    const Patch& patch_;
    LivingPatch living_;
    CostEstimate estimate_;
    ErrorForecast errors_;
    CollapseStar star_; // of the collapse that `trueCost` looked at last
    double most_;       // that a collapse may cost
    double claimed_ = 0;
    CollapseQueue queue_;
    std::vector<std::uint32_t> target_;   // per position in the queue
    std::vector<std::uint8_t> isChecked_; // whether its place in the queue is by its true cost
    std::vector<std::uint32_t> around_;   // neighbours of the collapse that is carried out
    std::vector<std::pair<double, std::uint32_t>> candidates_;
};

Collapser::Collapser(const Patch& patch)
    : patch_(patch),
      living_(patch),
      estimate_(patch, living_),
      errors_(patch, living_),
      star_(patch, living_),
      most_(patch.isAnyPrice ? kNever : kFairEdges * meanEdge(patch)),
      queue_(patch.positions.size()),
      target_(patch.positions.size(), kNone),
      isChecked_(patch.positions.size(), 0) {}

/// Calls `visit(q, square)` for each position that `p` may go into, with the estimate for it: its `neighbours`, and the
/// partner in another piece.
template <class Visit>
void Collapser::forTargets(std::uint32_t p, std::span<const std::uint32_t> neighbours, Visit visit) {
    const std::span<const double> squares = estimate_.squares(p, neighbours);
    for (std::size_t i = 0; i < neighbours.size(); ++i)
        visit(neighbours[i], squares[i]);
    const std::uint32_t q = living_.partner(p);
    if (q != kNone && q != p && living_.hasFaces(q))
        visit(q, estimate_.square(p, q) * kTopologyPenalty * kTopologyPenalty);
}

/// The cost of moving `from` onto `to` with all that is known of it; infinite if the collapse may not be, or where it
/// was found to cost `limit` or more.
double Collapser::trueCost(std::uint32_t from, std::uint32_t to, double limit) {
    star_.gather(from, to);
    if (star_.vanishingCount() >= living_.triangleCount()) return kNever; // something must remain
    if (star_.turnsFace() || star_.breaksLockedEdge()) return kNever;
    const double penalty = star_.changesTopology() ? kTopologyPenalty : 1;
    const double estimate = std::sqrt(estimate_.square(from, to));
    if (!patch_.isBounded) return penalty * estimate;
    if (!errors_.foresee(star_, limit)) return kNever;
    const double before = errors_.around(from);
    return std::max(errors_.worst(), before + estimate) + (penalty - 1) * (errors_.worst() - before);
}

/// What `p` would best go into by the estimates.
Collapser::Choice Collapser::cheapest(std::uint32_t p, std::span<const std::uint32_t> neighbours) {
    Choice best;
    forTargets(p, neighbours, [&](std::uint32_t q, double cost) {
        if (cost < best.cost || (cost == best.cost && q < best.target)) best = {cost, q};
    });
    if (best.target != kNone) best.cost = errors_.around(p) + std::sqrt(best.cost);
    return best;
}

/// What `p` would best go into by the true costs, of which that of `best` is known.
Collapser::Choice Collapser::cheapestAllowed(std::uint32_t p, Choice best) {
    candidates_.clear();
    forTargets(p, living_.neighbours(p), [&](std::uint32_t q, double cost) { candidates_.emplace_back(cost, q); });
    std::sort(candidates_.begin(), candidates_.end());
    const double before = errors_.around(p);
    const std::uint32_t first = best.target;
    if (best.cost == kNever) best.target = kNone;
    for (const auto& [cost, q] : candidates_) {
        if (before + std::sqrt(cost) >= best.cost) break;
        if (q == first) continue;
        const double allowed = trueCost(p, q, best.cost);
        if (allowed < best.cost) best = {allowed, q};
    }
    return best;
}

/// Puts `p`, whose neighbours are given, into the queue with the cost that is estimated now.
void Collapser::refresh(std::uint32_t p, std::span<const std::uint32_t> neighbours) {
    if (patch_.isLocked[p] != 0) return;
    const Choice choice = cheapest(p, neighbours);
    isChecked_[p] = 0;
    target_[p] = choice.target;
    if (choice.target == kNone)
        queue_.remove(p);
    else
        queue_.put(p, choice.cost);
}

/// Brings the queue up to date after `from` went into `to`.
void Collapser::refreshAround(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t q : around_) {
        if (!living_.isInPlace(q) || patch_.isLocked[q] != 0) continue;
        if (target_[q] == from || isChecked_[q] != 0 || !queue_.holds(q)) {
            refresh(q);
            continue;
        }
        const double estimate = std::sqrt(estimate_.square(q, to));
        if (estimate >= queue_.costOf(q)) continue; // most are, whatever the errors there
        const double cost = errors_.around(q) + estimate;
        if (cost >= queue_.costOf(q)) continue;
        target_[q] = to;
        queue_.put(q, cost);
    }
    const std::span<const std::uint32_t> neighbours = living_.neighbours(to);
    around_.clear();
    for (const std::uint32_t q : neighbours)
        if (!queue_.holds(q) && patch_.isLocked[q] == 0)
            around_.push_back(q); // nothing was allowed there; now something may be
    if (living_.isInPlace(to)) refresh(to, neighbours);
    for (const std::uint32_t q : around_)
        refresh(q);
}

/// Puts `p` into the queue with a true cost, if there is one.
void Collapser::putBack(std::uint32_t p, const Choice& choice) {
    if (choice.target == kNone) return;
    target_[p] = choice.target;
    isChecked_[p] = 1;
    queue_.put(p, choice.cost);
}

/// What `p`, which the queue believed to cost `cost`, is to go into; nothing if that turns out to be dearer, so that
/// others go first.
std::optional<Collapser::Choice> Collapser::inItsTurn(std::uint32_t p, double cost) {
    if (!living_.hasFaces(p)) return std::nullopt;
    const std::uint32_t to = target_[p];
    if (!living_.hasFaces(to)) { // vanished since
        refresh(p);
        return std::nullopt;
    }
    const Choice found{trueCost(p, to), to};
    if (!(found.cost <= kSlack * cost)) {
        putBack(p, cheapestAllowed(p, found));
        return std::nullopt;
    }
    if (found.cost > most_) {
        putBack(p, found);
        return std::nullopt;
    }
    return found;
}

/// Carries out the collapse that `trueCost` looked at last.
void Collapser::collapse(std::uint32_t from, std::uint32_t to) {
    claimed_ = std::max(claimed_, estimate_.planes(from, to));
    around_.clear();
    for (const std::uint32_t q : living_.neighbours(from))
        if (q != to) around_.push_back(q);
    errors_.take(star_);
    star_.carryOut();
    living_.join(from, to);
    estimate_.join(from, to);
    removeDoubled(to);
    for (const StarFace& face : star_.faces())
        if (star_.vanishes(face)) leave(face.b == to ? face.c : face.b);
    leave(to);
    refreshAround(from, to);
}

/// Of triangles at `p` with the same three positions only the first stays.
void Collapser::removeDoubled(std::uint32_t p) {
    for (const LivingPatch::Doubled& pair : living_.doubled(p)) {
        errors_.join(pair);
        living_.remove(pair.gone);
    }
}

/// Where the last triangle at `p` vanished: whoever looks for `p` finds the triangle that took what was left.
void Collapser::leave(std::uint32_t p) {
    if (living_.hasFaces(p)) return;
    queue_.remove(p);
    double best = kNever;
    for (const ErrorForecast::Outcome& outcome : errors_.outcomes()) {
        if (!living_.isAlive(outcome.triangle)) continue;
        for (const std::uint32_t q : living_.positions(outcome.triangle)) {
            const double square = proximity::squaredLength(patch_.positions[q] - patch_.positions[p]);
            if (square >= best) continue;
            best = square;
            living_.sendTo(p, q);
        }
    }
}

SimplifiedPatch Collapser::run(std::size_t targetTriangles) {
    std::vector<double> costs(patch_.positions.size(), kNever);
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p) {
        if (patch_.isLocked[p] != 0) continue;
        const Choice choice = cheapest(p, living_.neighbours(p));
        target_[p] = choice.target;
        costs[p] = choice.cost;
    }
    queue_.putAll(costs);
    const double enough = kEnoughShare * static_cast<double>(living_.triangleCount());
    double dearest = 0; // of the collapses until there is enough
    while (living_.triangleCount() > targetTriangles && !queue_.isEmpty()) {
        const bool isEnough = static_cast<double>(living_.triangleCount()) < enough;
        const double cost = queue_.least();
        if (cost > most_ || (isEnough && cost > kMostRise * dearest)) break;
        const std::uint32_t p = queue_.take();
        const std::optional<Choice> choice = inItsTurn(p, cost);
        if (!choice) continue;
        if (!isEnough) dearest = std::max(dearest, choice->cost);
        collapse(p, choice->target);
    }
    return result();
}

SimplifiedPatch Collapser::result() const {
    SimplifiedPatch result;
    for (std::uint32_t t = 0; t < patch_.triangles.size(); ++t) {
        if (!living_.isAlive(t)) continue;
        result.triangles.push_back(living_.vertices(t));
        result.origin.push_back(t);
        if (patch_.isBounded) result.errors.push_back(errors_.of(t));
    }
    result.movedTo.reserve(patch_.positions.size());
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p)
        result.movedTo.push_back(living_.whereNow(p));
    result.claimedError = std::sqrt(claimed_);
    return result;
}

} // namespace

SimplifiedPatch simplifyOwn(const Patch& patch, std::size_t targetTriangles) {
    return Collapser(patch).run(std::max<std::size_t>(targetTriangles, 1));
}

} // namespace gnomon::simplify
