#include "hierarchy/octahedral.h"
#include "preprocess/build/collapse_queue.h"
#include "preprocess/build/fan_map.h"
#include "preprocess/build/partners.h"
#include "preprocess/build/quadric.h"
#include "preprocess/build/simplify.h"
#include "preprocess/build/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::preprocess {

namespace {

using hierarchy::kNone;

// Costs are distances in grid steps, weights belong to their squares.
constexpr double kTopologyPenalty = 2;    // a change of topology must be half as far
constexpr double kLengthWeight = 1e-5;    // of the squared edge length: in flat places short edges go first
constexpr double kNormalWeight = 0.1;     // of the squared edge length times the squared change of the normal
constexpr double kColorWeight = 0.02;     // the same for colours, whose channels are in 0..1
constexpr double kBorderWeight = 2;       // of the squared length of an open edge, against the areas of faces
constexpr double kCreaseWeight = 0.5;     // the same where normals or colours part
constexpr double kLeastTurnCosine = 0.25; // faces turn by no more than 75 degrees in one collapse
constexpr double kSlack = 1.1;            // a collapse may cost so much more than its turn in the queue says
constexpr double kEnoughShare = 0.67;     // of the triangles: with so few left, a patch need not get fewer at any price
constexpr double kMostRise = 1.6;         // by how much the cost may rise from there
constexpr double kFairEdges = 2.5;        // mean edges of a patch: what a collapse may cost at a fair price

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

/// The state of one simplification.
class Collapser {
public:
    explicit Collapser(const Patch& patch);
    SimplifiedPatch run(std::size_t targetTriangles);

private:
    struct Choice {
        double cost = std::numeric_limits<double>::infinity();
        std::uint32_t target = kNone;
    };

    struct StarFace {
        std::uint32_t triangle;
        std::uint32_t b; // the two corners besides the star's centre, in order
        std::uint32_t c;
    };

    struct BothErrors {
        double fromSource = 0;
        double toSource = 0;
    };

    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    struct EdgeKind {
        bool isOpen = true;
        bool isCrease = false;
    };

    struct Heir {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = kNone;
    };

    double meanEdge() const;
    void linkCorners();
    void addFaceQuadrics();
    EdgeKind kindOfEdge(std::uint32_t corner) const;
    void addEdgeQuadrics();
    void loadAttributes();

    template <class Visit>
    void forCorners(std::uint32_t p, Visit visit);
    template <class Visit>
    void forNeighbours(std::uint32_t p, Visit visit);
    std::uint32_t whereNow(std::uint32_t p) const;
    bool hasFaces(std::uint32_t p);

    double rawCost(std::uint32_t from, std::uint32_t to) const;
    double attributeCost(std::uint32_t from, std::uint32_t to) const;
    void gatherStar(std::uint32_t from, std::uint32_t to);
    bool turnsFace(std::uint32_t from, std::uint32_t to) const;
    bool changesTopology(std::uint32_t from, std::uint32_t to);
    bool breaksLockedEdge(std::uint32_t to);
    bool orderFan(std::uint32_t from, std::uint32_t to);
    double triangleSquare(const glm::dvec3& p, const std::array<std::uint32_t, 3>& t) const;
    void addOutcome(std::uint32_t triangle, double fromSource, double toSource);
    double farthestSquare(
        const std::array<std::uint32_t, 3>& t, const std::array<std::uint32_t, 3>& corners, double limit) const;
    Heir heirOf(const std::array<std::uint32_t, 3>& t, std::uint32_t from, std::uint32_t to);
    bool foreseeErrors(std::uint32_t from, std::uint32_t to, double limit);
    double trueCost(std::uint32_t from, std::uint32_t to, double limit = std::numeric_limits<double>::infinity());
    Choice cheapest(std::uint32_t p);
    Choice cheapestAllowed(std::uint32_t p, Choice best);
    double errorAround(std::uint32_t p);
    void refresh(std::uint32_t p);
    void collapse(std::uint32_t from, std::uint32_t to);
    void takeOutcomes(std::uint32_t to);
    void moveStar(std::uint32_t from, std::uint32_t to);
    void joinCorners(std::uint32_t from, std::uint32_t to);
    void removeDoubled(std::uint32_t p);
    void leave(std::uint32_t p);
    void refreshAround(std::uint32_t from, std::uint32_t to);
    SimplifiedPatch result() const;
    std::uint32_t vertexAt(
        std::uint32_t vertex, std::uint32_t to, const std::vector<std::array<std::uint32_t, 2>>& joined);

    const Patch& patch_;
    std::vector<std::array<std::uint32_t, 3>> position_; // per triangle
    std::vector<std::array<std::uint32_t, 3>> vertex_;
    std::vector<glm::dvec3> firstNormal_; // of each triangle as it came, not of unit length
    std::vector<std::uint8_t> isAlive_;
    std::size_t aliveCount_ = 0;
    std::vector<std::uint32_t> head_; // per position: its first corner (3 * triangle + i)
    std::vector<std::uint32_t> tail_;
    std::vector<std::uint32_t> next_; // per corner
    std::vector<Quadric> quadric_;
    std::vector<std::uint8_t> isBorder_;
    std::vector<glm::dvec3> normal_; // per position, zero for none; empty if the patch has none
    std::vector<glm::dvec3> color_;  // per position; empty if all are alike
    std::vector<std::uint32_t> partner_;
    std::vector<std::uint32_t> movedTo_;
    std::vector<std::uint32_t> target_;
    std::vector<std::uint8_t> isChecked_;
    std::vector<std::uint32_t> stamp_;
    std::uint32_t stampNow_ = 0;
    std::vector<std::uint32_t> triangleStamp_;
    std::uint32_t triangleStampNow_ = 0;
    CollapseQueue queue_;
    double claimed_ = 0;
    std::vector<BothErrors> error_; // per triangle
    // Of the collapse under consideration:
    std::vector<StarFace> star_;
    std::uint32_t vanishing_ = 0;
    std::vector<std::array<std::uint32_t, 2>> ends_;
    std::vector<std::pair<double, std::uint32_t>> candidates_;
    Fan fan_;
    std::vector<std::uint32_t> around_;
    std::vector<std::array<std::uint32_t, 3>> sides_;
    std::vector<Outcome> outcomes_;
    std::vector<std::array<std::uint32_t, 2>> standIns_; // a vertex of the apex, and what replaces it
    double worst_ = 0;
};

Collapser::Collapser(const Patch& patch) : patch_(patch), queue_(patch.positions.size()) {
    const std::size_t positions = patch.positions.size();
    vertex_ = patch.triangles;
    position_.reserve(vertex_.size());
    for (const Triangle& t : patch.triangles)
        position_.push_back(patch.corners(t));
    aliveCount_ = vertex_.size();
    isAlive_.assign(vertex_.size(), 1);
    triangleStamp_.assign(vertex_.size(), 0);
    quadric_.resize(positions);
    isBorder_.assign(positions, 0);
    stamp_.assign(positions, 0);
    target_.assign(positions, kNone);
    isChecked_.assign(positions, 0);
    movedTo_.resize(positions);
    for (std::uint32_t p = 0; p < positions; ++p)
        movedTo_[p] = p;
    error_.reserve(vertex_.size());
    for (std::size_t t = 0; t < vertex_.size(); ++t)
        error_.push_back({patch.error(t).fromSource, patch.error(t).toSource});
    linkCorners();
    addFaceQuadrics();
    addEdgeQuadrics();
    loadAttributes();
    partner_ = nearestInOtherPieces(patch);
}

void Collapser::linkCorners() {
    head_.assign(patch_.positions.size(), kNone);
    tail_.assign(patch_.positions.size(), kNone);
    next_.assign(position_.size() * 3, kNone);
    for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
        const std::uint32_t p = position_[corner / 3][corner % 3];
        if (head_[p] == kNone)
            head_[p] = corner;
        else
            next_[tail_[p]] = corner;
        tail_[p] = corner;
    }
}

void Collapser::addFaceQuadrics() {
    firstNormal_.reserve(position_.size());
    for (const auto& t : position_) {
        const glm::dvec3& a = patch_.positions[t[0]];
        const glm::dvec3 normal = glm::cross(patch_.positions[t[1]] - a, patch_.positions[t[2]] - a);
        firstNormal_.push_back(normal);
        const double length = glm::length(normal);
        if (!(length > 0)) continue;
        for (const std::uint32_t p : t)
            quadric_[p].addPlane(normal / length, a, length * 0.5);
    }
}

/// The edge from `corner` to the next corner of its triangle: open where no other triangle has it, a crease where one
/// has it with other vertices.
Collapser::EdgeKind Collapser::kindOfEdge(std::uint32_t corner) const {
    const std::uint32_t t = corner / 3;
    const std::uint32_t i = corner % 3;
    const std::uint32_t b = position_[t][(i + 1) % 3];
    EdgeKind kind;
    for (std::uint32_t other = head_[position_[t][i]]; other != kNone; other = next_[other]) {
        const std::uint32_t u = other / 3;
        if (u == t) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (position_[u][k] != b) continue;
            kind.isOpen = false;
            if (vertex_[u][k] != vertex_[t][(i + 1) % 3] || vertex_[u][other % 3] != vertex_[t][i])
                kind.isCrease = true;
        }
    }
    return kind;
}

/// Open edges, and edges along which normals or colours part, get planes upright on their faces.
void Collapser::addEdgeQuadrics() {
    for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
        const std::uint32_t t = corner / 3;
        const std::uint32_t i = corner % 3;
        const std::uint32_t a = position_[t][i];
        const std::uint32_t b = position_[t][(i + 1) % 3];
        const auto [isOpen, isCrease] = kindOfEdge(corner);
        if (!isOpen && !isCrease) continue;
        if (isOpen && (patch_.isLocked[a] == 0 || patch_.isLocked[b] == 0)) isBorder_[a] = isBorder_[b] = 1;
        const glm::dvec3 edge = patch_.positions[b] - patch_.positions[a];
        const glm::dvec3 upright = glm::cross(edge, firstNormal_[t]);
        const double length = glm::length(upright);
        if (!(length > 0)) continue;
        const double weight = squared(edge) * (isOpen ? kBorderWeight : kCreaseWeight);
        quadric_[a].addPlane(upright / length, patch_.positions[a], weight);
        quadric_[b].addPlane(upright / length, patch_.positions[a], weight);
    }
}

void Collapser::loadAttributes() {
    bool hasNormals = false;
    bool hasColors = false;
    for (const Vertex& vertex : patch_.vertices) {
        hasNormals = hasNormals || vertex.normal != hierarchy::kNoNormal;
        hasColors = hasColors || vertex.color != patch_.vertices.front().color;
    }
    if (hasNormals) normal_.assign(patch_.positions.size(), glm::dvec3(0));
    if (hasColors) color_.assign(patch_.positions.size(), glm::dvec3(0));
    for (std::size_t v = patch_.vertices.size(); v-- > 0;) { // the first vertex of a position has the last word
        const Vertex& vertex = patch_.vertices[v];
        const std::uint32_t p = patch_.positionOf[v];
        if (hasNormals) normal_[p] = hierarchy::unpackNormal(vertex.normal);
        if (hasColors)
            color_[p] =
                glm::dvec3(vertex.color & 0xFFU, vertex.color >> 8U & 0xFFU, vertex.color >> 16U & 0xFFU) / 255.0;
    }
}

/// Calls `visit(corner)` for the corners of living triangles at `p`, and forgets those of dead ones.
template <class Visit>
void Collapser::forCorners(std::uint32_t p, Visit visit) {
    std::uint32_t last = kNone;
    for (std::uint32_t corner = head_[p]; corner != kNone; corner = next_[corner]) {
        if (isAlive_[corner / 3] == 0) {
            (last == kNone ? head_[p] : next_[last]) = next_[corner];
            continue;
        }
        last = corner;
        visit(corner);
    }
    tail_[p] = last;
}

/// Calls `visit(q)` once for each position that shares a living triangle with `p`.
template <class Visit>
void Collapser::forNeighbours(std::uint32_t p, Visit visit) {
    const std::uint32_t stamp = ++stampNow_;
    stamp_[p] = stamp;
    forCorners(p, [&](std::uint32_t corner) {
        const auto& t = position_[corner / 3];
        for (std::uint32_t k = 1; k < 3; ++k) {
            const std::uint32_t q = t[(corner % 3 + k) % 3];
            if (stamp_[q] == stamp) continue;
            stamp_[q] = stamp;
            visit(q);
        }
    });
}

std::uint32_t Collapser::whereNow(std::uint32_t p) const {
    while (movedTo_[p] != p)
        p = movedTo_[p];
    return p;
}

bool Collapser::hasFaces(std::uint32_t p) {
    forCorners(p, [](std::uint32_t /*corner*/) {});
    return head_[p] != kNone;
}

double Collapser::attributeCost(std::uint32_t from, std::uint32_t to) const {
    double cost = 0;
    if (!normal_.empty() && squared(normal_[from]) > 0 && squared(normal_[to]) > 0)
        cost += kNormalWeight * squared(normal_[from] - normal_[to]);
    if (!color_.empty()) cost += kColorWeight * squared(color_[from] - color_[to]);
    return cost;
}

double Collapser::rawCost(std::uint32_t from, std::uint32_t to) const {
    const double square = squared(patch_.positions[from] - patch_.positions[to]);
    const Quadric& quadric = quadric_[from];
    // Without any area there are no planes to tell how far is far.
    if (!(quadric.weight > 0)) return square * 0.01;
    return quadric.meanSquare(patch_.positions[to]) + square * (kLengthWeight + attributeCost(from, to));
}

/// Lists the living triangles around `from` and counts those that vanish where it collapses onto `to`.
void Collapser::gatherStar(std::uint32_t from, std::uint32_t to) {
    star_.clear();
    vanishing_ = 0;
    forCorners(from, [&](std::uint32_t corner) {
        const std::uint32_t t = corner / 3;
        const std::uint32_t i = corner % 3;
        const StarFace face{t, position_[t][(i + 1) % 3], position_[t][(i + 2) % 3]};
        if (face.b == to || face.c == to) ++vanishing_;
        star_.push_back(face);
    });
}

bool Collapser::turnsFace(std::uint32_t from, std::uint32_t to) const {
    const glm::dvec3& origin = patch_.positions[from];
    const glm::dvec3& target = patch_.positions[to];
    for (const StarFace& face : star_) {
        if (face.b == to || face.c == to) continue;
        const glm::dvec3& b = patch_.positions[face.b];
        const glm::dvec3 side = patch_.positions[face.c] - b;
        const glm::dvec3 before = glm::cross(side, origin - b);
        const glm::dvec3 after = glm::cross(side, target - b);
        const double square = squared(before);
        const double turned = glm::dot(before, after);
        if (square > 0 &&
            (turned <= 0 || turned * turned < kLeastTurnCosine * kLeastTurnCosine * square * squared(after)))
            return true;
        const glm::dvec3& first = firstNormal_[face.triangle];
        if (glm::dot(first, after) <= 0 && squared(first) > 0) return true;
    }
    return false;
}

/// Whether the two ends have neighbours in common besides those of the triangles that vanish, or are both on a border
/// across which the edge leads, or have no edge.
bool Collapser::changesTopology(std::uint32_t from, std::uint32_t to) {
    if (vanishing_ == 0) return true;
    if (vanishing_ > 1 && isBorder_[from] != 0 && isBorder_[to] != 0) return true;
    stampNow_ += 2;
    const std::uint32_t stamp = stampNow_;
    for (const StarFace& face : star_)
        stamp_[face.b] = stamp_[face.c] = stamp;
    stamp_[to] = stamp_[from] = stamp - 1;
    std::size_t common = 0;
    forCorners(to, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3])
            if (stamp_[q] == stamp) {
                stamp_[q] = stamp - 1; // counted
                ++common;
            }
    });
    return common > vanishing_;
}

/// Whether an edge between two locked positions would gain or lose a face: groups on its other side count on it.
bool Collapser::breaksLockedEdge(std::uint32_t to) {
    if (patch_.isLocked[to] == 0) return false;
    ends_.clear(); // locked neighbour, 1 if its face vanishes
    for (const StarFace& face : star_) {
        const std::uint32_t vanishes = face.b == to || face.c == to ? 1 : 0;
        if (face.b != to && patch_.isLocked[face.b] != 0) ends_.push_back({face.b, vanishes});
        if (face.c != to && patch_.isLocked[face.c] != 0) ends_.push_back({face.c, vanishes});
    }
    if (ends_.empty()) return false;
    std::sort(ends_.begin(), ends_.end());
    std::int64_t balance = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        balance += ends_[i][1] != 0 ? 1 : -1;
        if (i + 1 < ends_.size() && ends_[i + 1][0] == ends_[i][0]) continue;
        if (balance != 0) return true;
    }
    return false;
}

/// Orders the star as a fan from `to` onwards, edge to edge; false if it is none.
bool Collapser::orderFan(std::uint32_t from, std::uint32_t to) {
    const std::size_t count = star_.size();
    if (vanishing_ == 0 || vanishing_ > 2 || count < 2 || count >= Fan::kMaxRim) return false;
    fan_.count = 0;
    std::uint32_t at = to;
    for (std::size_t done = 0; done < count; ++done) {
        std::size_t next = done; // the star's faces before `done` are in order
        while (next < count && star_[next].b != at && star_[next].c != at)
            ++next;
        if (next == count) return false;
        std::swap(star_[done], star_[next]);
        const StarFace& face = star_[done];
        fan_.rim[fan_.count] = patch_.positions[at];
        fan_.fromSource[fan_.count] = error_[face.triangle].fromSource;
        fan_.toSource[fan_.count] = error_[face.triangle].toSource;
        ++fan_.count;
        at = face.b == at ? face.c : face.b;
        if (at == to && done + 1 < count) return false;
    }
    fan_.isClosed = at == to;
    if (fan_.isClosed != (vanishing_ == 2)) return false;
    if (!fan_.isClosed) fan_.rim[fan_.count++] = patch_.positions[at];
    if (fan_.count < 3) return false;
    fan_.apex = patch_.positions[from];
    return true;
}

double Collapser::triangleSquare(const glm::dvec3& p, const std::array<std::uint32_t, 3>& t) const {
    return nearestSquare(p, patch_.positions[t[0]], patch_.positions[t[1]], patch_.positions[t[2]]);
}

/// What a triangle answers for besides its own source points, once it has taken those of another.
void Collapser::addOutcome(std::uint32_t triangle, double fromSource, double toSource) {
    outcomes_.push_back({triangle, fromSource, toSource});
    worst_ = std::max({worst_, fromSource, toSource});
}

/// The largest squared distance of a corner of `t` from the triangle `corners`, or the first one above `limit`.
double Collapser::farthestSquare(
    const std::array<std::uint32_t, 3>& t, const std::array<std::uint32_t, 3>& corners, double limit) const {
    double square = 0;
    for (const std::uint32_t p : t) {
        if (p == corners[0] || p == corners[1] || p == corners[2]) continue;
        square = std::max(square, triangleSquare(patch_.positions[p], corners));
        if (square > limit) break;
    }
    return square;
}

/// The triangle among `t`'s new neighbours, or failing them near its piece, that has the source points of `t` nearest.
/// A convex set's distance is convex: where the corners of `t` are within it, so is all of `t`.
Collapser::Heir Collapser::heirOf(const std::array<std::uint32_t, 3>& t, std::uint32_t from, std::uint32_t to) {
    Heir heir;
    const std::uint32_t stamp = ++triangleStampNow_;
    const auto consider = [&](std::uint32_t candidate) {
        if (triangleStamp_[candidate] == stamp) return;
        triangleStamp_[candidate] = stamp;
        auto corners = position_[candidate];
        std::replace(corners.begin(), corners.end(), from, to);
        if ((corners[0] == corners[1]) || (corners[1] == corners[2]) || (corners[2] == corners[0])) return;
        const double square = farthestSquare(t, corners, heir.square);
        if (square < heir.square || (square == heir.square && candidate < heir.triangle)) heir = {square, candidate};
    };
    const auto considerAround = [&](std::uint32_t p) {
        forCorners(p, [&](std::uint32_t corner) { consider(corner / 3); });
    };
    for (const std::uint32_t p : t)
        considerAround(p);
    if (heir.triangle != kNone || partner_.empty()) return heir;
    for (const std::uint32_t p : t)
        if (partner_[p] != kNone) considerAround(whereNow(partner_[p]));
    return heir;
}

/// Bounds what the collapse does to each triangle that stays, or takes what another leaves; false if nobody can, or if
/// one of the bounds reaches `limit`.
bool Collapser::foreseeErrors(std::uint32_t from, std::uint32_t to, double limit) {
    outcomes_.clear();
    worst_ = 0;
    if (orderFan(from, to)) {
        const FanAfter after = mapFan(fan_);
        for (std::uint32_t j = 1; j + 1 < fan_.count; ++j)
            addOutcome(star_[j].triangle, after.fromSource[j], after.toSource[j]);
        return true;
    }
    const glm::dvec3& origin = patch_.positions[from];
    const glm::dvec3& target = patch_.positions[to];
    for (const StarFace& face : star_) {
        if (worst_ >= limit) return false;
        const BothErrors& before = error_[face.triangle];
        if (face.b != to && face.c != to) {
            const glm::dvec3& b = patch_.positions[face.b];
            const glm::dvec3& c = patch_.positions[face.c];
            addOutcome(
                face.triangle,
                before.fromSource + std::sqrt(nearestSquare(origin, target, b, c)),
                before.toSource + std::sqrt(nearestSquare(target, origin, b, c)));
            continue;
        }
        const Heir heir = heirOf({from, face.b, face.c}, from, to);
        if (heir.triangle == kNone) return false;
        addOutcome(heir.triangle, before.fromSource + std::sqrt(heir.square), 0);
    }
    return true;
}

/// The cost of moving `from` onto `to` with all that is known of it; infinite if the collapse may not be, or where it
/// was found to cost `limit` or more.
double Collapser::trueCost(std::uint32_t from, std::uint32_t to, double limit) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    gatherStar(from, to);
    if (vanishing_ >= aliveCount_) return kNever; // something must remain
    if (turnsFace(from, to) || breaksLockedEdge(to)) return kNever;
    const double penalty = changesTopology(from, to) ? kTopologyPenalty : 1;
    if (!patch_.isBounded) return penalty * std::sqrt(rawCost(from, to));
    if (!foreseeErrors(from, to, limit)) return kNever;
    double before = 0;
    for (const StarFace& face : star_)
        before = std::max({before, error_[face.triangle].fromSource, error_[face.triangle].toSource});
    return std::max(worst_, before + std::sqrt(rawCost(from, to))) + (penalty - 1) * (worst_ - before);
}

/// The largest error of the triangles around `p`; 0 where errors are not asked for.
double Collapser::errorAround(std::uint32_t p) {
    if (!patch_.isBounded) return 0;
    double before = 0;
    forCorners(p, [&](std::uint32_t corner) {
        before = std::max({before, error_[corner / 3].fromSource, error_[corner / 3].toSource});
    });
    return before;
}

Collapser::Choice Collapser::cheapest(std::uint32_t p) {
    Choice best;
    const auto consider = [&](std::uint32_t q, double factor) {
        const double cost = rawCost(p, q) * factor;
        if (cost < best.cost || (cost == best.cost && q < best.target)) best = {cost, q};
    };
    forNeighbours(p, [&](std::uint32_t q) { consider(q, 1); });
    if (!partner_.empty() && partner_[p] != kNone)
        if (const std::uint32_t q = whereNow(partner_[p]); q != p && hasFaces(q))
            consider(q, kTopologyPenalty * kTopologyPenalty);
    if (best.target != kNone) best.cost = errorAround(p) + std::sqrt(best.cost);
    return best;
}

Collapser::Choice Collapser::cheapestAllowed(std::uint32_t p, Choice best) {
    candidates_.clear();
    forNeighbours(p, [&](std::uint32_t q) { candidates_.emplace_back(rawCost(p, q), q); });
    if (!partner_.empty() && partner_[p] != kNone)
        if (const std::uint32_t q = whereNow(partner_[p]); q != p && hasFaces(q))
            candidates_.emplace_back(rawCost(p, q) * kTopologyPenalty * kTopologyPenalty, q);
    std::sort(candidates_.begin(), candidates_.end());
    const double before = errorAround(p);
    const std::uint32_t first = best.target;
    if (best.cost == std::numeric_limits<double>::infinity()) best.target = kNone;
    for (const auto& [cost, q] : candidates_) {
        if (before + std::sqrt(cost) >= best.cost) break;
        if (q == first) continue;
        const double allowed = trueCost(p, q, best.cost);
        if (allowed < best.cost) best = {allowed, q};
    }
    return best;
}

/// Puts `p` back into the queue with the cost that it has now.
void Collapser::refresh(std::uint32_t p) {
    if (patch_.isLocked[p] != 0) return;
    const Choice choice = cheapest(p);
    isChecked_[p] = 0;
    target_[p] = choice.target;
    if (choice.target == kNone)
        queue_.remove(p);
    else
        queue_.put(p, choice.cost);
}

/// The vertex at `to` that stands in for `vertex`: the one joined to it by a vanishing triangle, else the most alike.
std::uint32_t Collapser::vertexAt(
    std::uint32_t vertex, std::uint32_t to, const std::vector<std::array<std::uint32_t, 2>>& joined) {
    for (const auto& [from, onto] : joined)
        if (from == vertex) return onto;
    std::uint32_t best = kNone;
    double bestDifference = std::numeric_limits<double>::infinity();
    const Vertex& wanted = patch_.vertices[vertex];
    const auto channel = [](std::uint32_t color, std::uint32_t shift) {
        return static_cast<double>(color >> shift & 0xFFU) / 255.0;
    };
    forCorners(to, [&](std::uint32_t corner) {
        const std::uint32_t candidate = vertex_[corner / 3][corner % 3];
        if (candidate == best) return;
        const Vertex& v = patch_.vertices[candidate];
        double difference = squared(hierarchy::unpackNormal(v.normal) - hierarchy::unpackNormal(wanted.normal));
        for (const std::uint32_t shift : {0U, 8U, 16U, 24U}) {
            const double d = channel(v.color, shift) - channel(wanted.color, shift);
            difference += d * d;
        }
        if (difference < bestDifference || (difference == bestDifference && candidate < best)) {
            bestDifference = difference;
            best = candidate;
        }
    });
    return best;
}

/// The errors of the triangles that stay are those that were foreseen.
void Collapser::takeOutcomes(std::uint32_t to) {
    for (const StarFace& face : star_)
        if (face.b != to && face.c != to) error_[face.triangle] = {};
    for (const Outcome& outcome : outcomes_) {
        BothErrors& error = error_[outcome.triangle];
        error.fromSource = std::max(error.fromSource, outcome.fromSource);
        error.toSource = std::max(error.toSource, outcome.toSource);
    }
}

/// Puts `to` in the place of `from` into the triangles that stay, and takes the others out.
void Collapser::moveStar(std::uint32_t from, std::uint32_t to) {
    standIns_.clear();
    for (const StarFace& face : star_) {
        const auto& t = position_[face.triangle];
        const auto& v = vertex_[face.triangle];
        const auto placeOf = [&t](std::uint32_t p) { return t[0] == p ? 0U : (t[1] == p ? 1U : 2U); };
        if (face.b == to || face.c == to) standIns_.push_back({v[placeOf(from)], v[placeOf(to)]});
    }
    for (const StarFace& face : star_) {
        if (face.b == to || face.c == to) continue;
        auto& t = position_[face.triangle];
        const std::size_t i = t[0] == from ? 0 : (t[1] == from ? 1 : 2);
        std::uint32_t& vertex = vertex_[face.triangle][i];
        const std::uint32_t standIn = vertexAt(vertex, to, standIns_);
        standIns_.push_back({vertex, standIn});
        vertex = standIn;
        t[i] = to;
    }
    for (const StarFace& face : star_)
        if (face.b == to || face.c == to) isAlive_[face.triangle] = 0;
    aliveCount_ -= vanishing_;
}

/// Hands the corners of `from` on to `to`.
void Collapser::joinCorners(std::uint32_t from, std::uint32_t to) {
    if (head_[to] == kNone)
        head_[to] = head_[from];
    else
        next_[tail_[to]] = head_[from];
    if (tail_[from] != kNone) tail_[to] = tail_[from];
    head_[from] = tail_[from] = kNone;
}

/// Carries out the collapse that `trueCost` looked at last.
void Collapser::collapse(std::uint32_t from, std::uint32_t to) {
    takeOutcomes(to);
    moveStar(from, to);
    joinCorners(from, to);
    quadric_[to].add(quadric_[from]);
    isBorder_[to] |= isBorder_[from];
    movedTo_[from] = to;
    if (!partner_.empty() && partner_[to] == kNone && patch_.isLocked[to] == 0) partner_[to] = partner_[from];
    removeDoubled(to);
    for (const StarFace& face : star_)
        if (face.b == to || face.c == to) leave(face.b == to ? face.c : face.b);
    leave(to);
}

/// Where the last triangle at `p` vanished: whoever looks for `p` finds the triangle that took what was left.
void Collapser::leave(std::uint32_t p) {
    if (hasFaces(p)) return;
    queue_.remove(p);
    double best = std::numeric_limits<double>::infinity();
    for (const Outcome& outcome : outcomes_) {
        if (isAlive_[outcome.triangle] == 0) continue;
        for (const std::uint32_t q : position_[outcome.triangle]) {
            const double square = squared(patch_.positions[q] - patch_.positions[p]);
            if (square >= best) continue;
            best = square;
            movedTo_[p] = q;
        }
    }
}

/// Of triangles at `p` with the same three positions only the first stays.
void Collapser::removeDoubled(std::uint32_t p) {
    sides_.clear(); // lesser position, greater position, triangle
    forCorners(p, [&](std::uint32_t corner) {
        const auto& t = position_[corner / 3];
        const std::uint32_t a = t[(corner % 3 + 1) % 3];
        const std::uint32_t b = t[(corner % 3 + 2) % 3];
        sides_.push_back({std::min(a, b), std::max(a, b), corner / 3});
    });
    std::sort(sides_.begin(), sides_.end());
    const auto locked = [&](std::uint32_t q) { return patch_.isLocked[q] != 0 ? 1 : 0; };
    std::size_t first = 0;
    for (std::size_t i = 1; i < sides_.size(); ++i) {
        if (sides_[i][0] != sides_[first][0] || sides_[i][1] != sides_[first][1]) {
            first = i;
            continue;
        }
        if (locked(p) + locked(sides_[i][0]) + locked(sides_[i][1]) > 1) continue; // a locked edge keeps its faces
        BothErrors& kept = error_[sides_[first][2]];
        const BothErrors& gone = error_[sides_[i][2]];
        kept = {std::max(kept.fromSource, gone.fromSource), std::min(kept.toSource, gone.toSource)};
        isAlive_[sides_[i][2]] = 0;
        --aliveCount_;
    }
}

/// The mean length of the edges as they came.
double Collapser::meanEdge() const {
    double length = 0;
    for (const Triangle& t : patch_.triangles) {
        const Triangle p = patch_.corners(t);
        for (std::size_t i = 0; i < 3; ++i)
            length += glm::distance(patch_.positions[p[i]], patch_.positions[p[(i + 1) % 3]]);
    }
    return length / (3.0 * static_cast<double>(patch_.triangles.size()));
}

SimplifiedPatch Collapser::run(std::size_t targetTriangles) {
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p)
        refresh(p);
    const double enough = kEnoughShare * static_cast<double>(aliveCount_);
    double dearest = 0;
    const double most = patch_.isAnyPrice ? std::numeric_limits<double>::infinity() : kFairEdges * meanEdge();
    while (aliveCount_ > targetTriangles && !queue_.isEmpty()) {
        const double cost = queue_.least();
        if (cost > most) break;
        if (static_cast<double>(aliveCount_) < enough && cost > kMostRise * dearest) break;
        const std::uint32_t p = queue_.take();
        if (!hasFaces(p)) continue;
        const std::uint32_t to = target_[p];
        if (!hasFaces(to)) { // vanished since
            refresh(p);
            continue;
        }
        const double found = trueCost(p, to);
        if (!(found <= kSlack * cost)) {
            const Choice choice = cheapestAllowed(p, {found, to});
            if (choice.target == kNone) continue;
            target_[p] = choice.target;
            isChecked_[p] = 1;
            queue_.put(p, choice.cost);
            continue;
        }
        if (found > most) {
            isChecked_[p] = 1;
            queue_.put(p, found);
            continue;
        }
        if (static_cast<double>(aliveCount_) >= enough) dearest = std::max(dearest, found);
        claimed_ = std::max(claimed_, quadric_[p].meanSquare(patch_.positions[to]));
        around_.clear();
        forNeighbours(p, [&](std::uint32_t q) {
            if (q != to) around_.push_back(q);
        });
        collapse(p, to);
        refreshAround(p, to);
    }
    return result();
}

SimplifiedPatch Collapser::result() const {
    SimplifiedPatch result;
    for (std::uint32_t t = 0; t < vertex_.size(); ++t) {
        if (isAlive_[t] == 0) continue;
        result.triangles.push_back(vertex_[t]);
        result.origin.push_back(t);
        if (patch_.isBounded) result.errors.push_back({roundedUp(error_[t].fromSource), roundedUp(error_[t].toSource)});
    }
    result.movedTo = movedTo_;
    for (std::uint32_t& p : result.movedTo)
        p = whereNow(p);
    result.claimedError = std::sqrt(claimed_);
    return result;
}

/// Brings the queue up to date after `from` went into `to`.
void Collapser::refreshAround(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t q : around_) {
        if (movedTo_[q] != q || patch_.isLocked[q] != 0) continue;
        if (target_[q] == from || isChecked_[q] != 0 || !queue_.holds(q)) {
            refresh(q);
            continue;
        }
        const double cost = errorAround(q) + std::sqrt(rawCost(q, to));
        if (cost >= queue_.costOf(q)) continue;
        target_[q] = to;
        queue_.put(q, cost);
    }
    around_.clear();
    forNeighbours(to, [&](std::uint32_t q) {
        if (!queue_.holds(q)) around_.push_back(q); // nothing was allowed there; now something may be
    });
    for (const std::uint32_t q : around_)
        refresh(q);
    if (movedTo_[to] == to) refresh(to);
}

} // namespace

SimplifiedPatch simplifyOwn(const Patch& patch, std::size_t targetTriangles) {
    return Collapser(patch).run(std::max<std::size_t>(targetTriangles, 1));
}

} // namespace gnomon::preprocess
