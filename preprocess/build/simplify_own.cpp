#include "hierarchy/octahedral.h"
#include "preprocess/build/collapse_queue.h"
#include "preprocess/build/partners.h"
#include "preprocess/build/quadric.h"
#include "preprocess/build/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::preprocess {

namespace {

using hierarchy::kNone;

// Costs are squared distances in grid steps.
constexpr double kTopologyPenalty = 4;    // a change of topology must be half as far
constexpr double kLengthWeight = 1e-5;    // of the squared edge length: in flat places short edges go first
constexpr double kNormalWeight = 0.01;    // of the squared edge length times the squared change of the normal
constexpr double kColorWeight = 0.02;     // the same for colours, whose channels are in 0..1
constexpr double kBorderWeight = 2;       // of the squared length of an open edge, against the areas of faces
constexpr double kCreaseWeight = 0.5;     // the same where normals or colours part
constexpr double kLeastTurnCosine = 0.25; // faces turn by no more than 75 degrees in one collapse

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

    void linkCorners();
    void addFaceQuadrics();
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
    double penalty(std::uint32_t from, std::uint32_t to);
    bool turnsFace(std::uint32_t from, std::uint32_t to);
    bool changesTopology(std::uint32_t from, std::uint32_t to);
    bool breaksLockedEdge(std::uint32_t from, std::uint32_t to);
    Choice cheapest(std::uint32_t p);
    Choice cheapestAllowed(std::uint32_t p);
    void refresh(std::uint32_t p);
    void collapse(std::uint32_t from, std::uint32_t to);
    void removeDoubled(std::uint32_t p);
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
    CollapseQueue queue_;
    double claimed_ = 0;
};

Collapser::Collapser(const Patch& patch) : patch_(patch), queue_(patch.positions.size()) {
    const std::size_t positions = patch.positions.size();
    vertex_ = patch.triangles;
    position_.reserve(vertex_.size());
    for (const Triangle& t : patch.triangles)
        position_.push_back(patch.corners(t));
    aliveCount_ = vertex_.size();
    isAlive_.assign(vertex_.size(), 1);
    quadric_.resize(positions);
    isBorder_.assign(positions, 0);
    stamp_.assign(positions, 0);
    target_.assign(positions, kNone);
    isChecked_.assign(positions, 0);
    movedTo_.resize(positions);
    for (std::uint32_t p = 0; p < positions; ++p)
        movedTo_[p] = p;
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

/// Open edges, and edges along which normals or colours part, get planes upright on their faces.
void Collapser::addEdgeQuadrics() {
    for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
        const std::uint32_t t = corner / 3;
        const std::uint32_t i = corner % 3;
        const std::uint32_t a = position_[t][i];
        const std::uint32_t b = position_[t][(i + 1) % 3];
        bool isOpen = true;
        bool isCrease = false;
        for (std::uint32_t other = head_[a]; other != kNone; other = next_[other]) {
            const std::uint32_t u = other / 3;
            if (u == t) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (position_[u][k] != b) continue;
                isOpen = false;
                isCrease =
                    isCrease || vertex_[u][k] != vertex_[t][(i + 1) % 3] || vertex_[u][other % 3] != vertex_[t][i];
            }
        }
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

bool Collapser::turnsFace(std::uint32_t from, std::uint32_t to) {
    bool turns = false;
    const glm::dvec3& target = patch_.positions[to];
    forCorners(from, [&](std::uint32_t corner) {
        const std::uint32_t t = corner / 3;
        const std::uint32_t b = position_[t][(corner + 1 - 3 * t) % 3];
        const std::uint32_t c = position_[t][(corner + 2 - 3 * t) % 3];
        if (turns || b == to || c == to) return;
        const glm::dvec3& pb = patch_.positions[b];
        const glm::dvec3 side = patch_.positions[c] - pb;
        const glm::dvec3 before = glm::cross(side, patch_.positions[from] - pb);
        const glm::dvec3 after = glm::cross(side, target - pb);
        const double lengths = squared(before) * squared(after);
        const double turned = glm::dot(before, after);
        const bool hadArea = squared(before) > 0;
        if (hadArea && (turned <= 0 || turned * turned < kLeastTurnCosine * kLeastTurnCosine * lengths)) turns = true;
        if (squared(firstNormal_[t]) > 0 && glm::dot(firstNormal_[t], after) <= 0) turns = true;
    });
    return turns;
}

/// Whether the two ends have neighbours in common besides those of the triangles that vanish, or are both on a border
/// across which the edge leads, or have no edge.
bool Collapser::changesTopology(std::uint32_t from, std::uint32_t to) {
    std::size_t shared = 0;
    forCorners(from, [&](std::uint32_t corner) {
        const auto& t = position_[corner / 3];
        if (t[0] == to || t[1] == to || t[2] == to) ++shared;
    });
    if (shared == 0) return true;
    if (shared > 1 && isBorder_[from] != 0 && isBorder_[to] != 0) return true;
    forNeighbours(from, [](std::uint32_t /*q*/) {});
    const std::uint32_t stamp = stampNow_;
    std::size_t common = 0;
    forCorners(to, [&](std::uint32_t corner) {
        for (const std::uint32_t q : position_[corner / 3])
            if (q != to && q != from && stamp_[q] == stamp) {
                stamp_[q] = stamp - 1; // counted
                ++common;
            }
    });
    return common > shared;
}

/// Whether an edge between two locked positions would gain or lose a face: groups on its other side count on it.
bool Collapser::breaksLockedEdge(std::uint32_t from, std::uint32_t to) {
    if (patch_.isLocked[to] == 0) return false;
    std::vector<std::array<std::uint32_t, 2>> ends; // locked neighbour, 1 if its face with `from` vanishes
    forCorners(from, [&](std::uint32_t corner) {
        const auto& t = position_[corner / 3];
        const std::uint32_t vanishes = t[0] == to || t[1] == to || t[2] == to ? 1 : 0;
        for (const std::uint32_t q : t)
            if (q != from && q != to && patch_.isLocked[q] != 0) ends.push_back({q, vanishes});
    });
    std::sort(ends.begin(), ends.end());
    std::int64_t balance = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        balance += ends[i][1] != 0 ? 1 : -1;
        if (i + 1 < ends.size() && ends[i + 1][0] == ends[i][0]) continue;
        if (balance != 0) return true;
    }
    return false;
}

/// What to multiply the cost with; infinite if the collapse may not be.
double Collapser::penalty(std::uint32_t from, std::uint32_t to) {
    if (turnsFace(from, to) || breaksLockedEdge(from, to)) return std::numeric_limits<double>::infinity();
    return changesTopology(from, to) ? kTopologyPenalty : 1;
}

Collapser::Choice Collapser::cheapest(std::uint32_t p) {
    Choice best;
    const auto consider = [&](std::uint32_t q, double factor) {
        const double cost = rawCost(p, q) * factor;
        if (cost < best.cost || (cost == best.cost && q < best.target)) best = {cost, q};
    };
    forNeighbours(p, [&](std::uint32_t q) { consider(q, 1); });
    if (!partner_.empty() && partner_[p] != kNone)
        if (const std::uint32_t q = whereNow(partner_[p]); q != p && hasFaces(q)) consider(q, kTopologyPenalty);
    return best;
}

Collapser::Choice Collapser::cheapestAllowed(std::uint32_t p) {
    std::vector<std::uint32_t> candidates;
    forNeighbours(p, [&](std::uint32_t q) { candidates.push_back(q); });
    if (!partner_.empty() && partner_[p] != kNone)
        if (const std::uint32_t q = whereNow(partner_[p]); q != p && hasFaces(q)) candidates.push_back(q);
    Choice best;
    for (const std::uint32_t q : candidates) {
        const double cost = rawCost(p, q);
        if (cost > best.cost) continue;
        const double allowed = cost * penalty(p, q);
        if (!(allowed < std::numeric_limits<double>::infinity())) continue; // no last resort: it may not be at all
        if (allowed < best.cost || (allowed == best.cost && q < best.target)) best = {allowed, q};
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

void Collapser::collapse(std::uint32_t from, std::uint32_t to) {
    std::vector<std::array<std::uint32_t, 2>> joined;
    std::vector<std::uint32_t> moved;
    forCorners(from, [&](std::uint32_t corner) {
        const std::uint32_t t = corner / 3;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (position_[t][k] == to) joined.push_back({vertex_[t][corner % 3], vertex_[t][k]});
        moved.push_back(corner);
    });
    std::vector<std::array<std::uint32_t, 2>> standIns = joined;
    for (const std::uint32_t corner : moved) {
        const std::uint32_t vertex = vertex_[corner / 3][corner % 3];
        const std::uint32_t standIn = vertexAt(vertex, to, standIns);
        standIns.push_back({vertex, standIn});
    }
    for (const std::uint32_t corner : moved) {
        const std::uint32_t t = corner / 3;
        if (position_[t][0] == to || position_[t][1] == to || position_[t][2] == to) {
            isAlive_[t] = 0;
            --aliveCount_;
            continue;
        }
        vertex_[t][corner % 3] = vertexAt(vertex_[t][corner % 3], to, standIns);
        position_[t][corner % 3] = to;
    }
    if (head_[to] == kNone)
        head_[to] = head_[from];
    else
        next_[tail_[to]] = head_[from];
    if (tail_[from] != kNone) tail_[to] = tail_[from];
    head_[from] = tail_[from] = kNone;
    quadric_[to].add(quadric_[from]);
    isBorder_[to] |= isBorder_[from];
    movedTo_[from] = to;
    if (!partner_.empty() && partner_[to] == kNone && patch_.isLocked[to] == 0) partner_[to] = partner_[from];
    removeDoubled(to);
}

/// Of triangles at `p` with the same three positions only the first stays.
void Collapser::removeDoubled(std::uint32_t p) {
    std::vector<std::array<std::uint32_t, 3>> sides; // lesser position, greater position, triangle
    forCorners(p, [&](std::uint32_t corner) {
        const auto& t = position_[corner / 3];
        const std::uint32_t a = t[(corner % 3 + 1) % 3];
        const std::uint32_t b = t[(corner % 3 + 2) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), corner / 3});
    });
    std::sort(sides.begin(), sides.end());
    const auto locked = [&](std::uint32_t q) { return patch_.isLocked[q] != 0 ? 1 : 0; };
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i][0] != sides[i - 1][0] || sides[i][1] != sides[i - 1][1] || aliveCount_ == 1) continue;
        if (locked(p) + locked(sides[i][0]) + locked(sides[i][1]) > 1) continue; // a locked edge keeps its faces
        isAlive_[sides[i][2]] = 0;
        --aliveCount_;
    }
}

SimplifiedPatch Collapser::run(std::size_t targetTriangles) {
    for (std::uint32_t p = 0; p < patch_.positions.size(); ++p)
        refresh(p);
    std::vector<std::uint32_t> around;
    while (aliveCount_ > targetTriangles && !queue_.isEmpty()) {
        const std::uint32_t p = queue_.take();
        if (!hasFaces(p)) continue;
        if (!hasFaces(target_[p])) { // vanished since
            refresh(p);
            continue;
        }
        if (isChecked_[p] == 0) {
            if (penalty(p, target_[p]) != 1) {
                const Choice choice = cheapestAllowed(p);
                if (choice.target == kNone) continue;
                target_[p] = choice.target;
                isChecked_[p] = 1;
                queue_.put(p, choice.cost);
                continue;
            }
        }
        const std::uint32_t to = target_[p];
        std::size_t dying = 0;
        forCorners(p, [&](std::uint32_t corner) {
            const auto& t = position_[corner / 3];
            if (t[0] == to || t[1] == to || t[2] == to) ++dying;
        });
        if (dying >= aliveCount_) continue; // something must remain
        claimed_ = std::max(claimed_, quadric_[p].meanSquare(patch_.positions[to]));
        around.clear();
        forNeighbours(p, [&](std::uint32_t q) { around.push_back(q); });
        collapse(p, to);
        forNeighbours(to, [&](std::uint32_t q) { around.push_back(q); });
        around.push_back(to);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        for (const std::uint32_t q : around)
            if (movedTo_[q] == q) refresh(q);
    }
    SimplifiedPatch result;
    for (std::uint32_t t = 0; t < vertex_.size(); ++t) {
        if (isAlive_[t] == 0) continue;
        result.triangles.push_back(vertex_[t]);
        result.origin.push_back(t);
    }
    result.movedTo = movedTo_;
    for (std::uint32_t& p : result.movedTo)
        p = whereNow(p);
    result.claimedError = std::sqrt(claimed_);
    return result;
}

} // namespace

SimplifiedPatch simplifyOwn(const Patch& patch, std::size_t targetTriangles) {
    return Collapser(patch).run(std::max<std::size_t>(targetTriangles, 1));
}

} // namespace gnomon::preprocess
