// What is left of a patch while it is simplified: its living triangles, linked around their positions, and where the
// positions went that are no more.
#pragma once

#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::simplify {

/// What lies at an edge of a patch as it came: no other triangle, or one with other vertices, or one with the same.
enum class EdgeKind : std::uint8_t { Open, Crease, Smooth };

/// Triangles are known by their place in the patch, corners by 3 * triangle + their place in the triangle. Walks around
/// a position forget the dead triangles that they meet, so they are not const.
class LivingPatch {
public:
    explicit LivingPatch(const Patch& patch);

    std::size_t triangleCount() const { return alive_; }

    bool isAlive(std::uint32_t triangle) const { return isAlive_[triangle] != 0; }

    /// The positions that a triangle has now.
    const Triangle& positions(std::uint32_t triangle) const { return position_[triangle]; }

    /// The vertices that a triangle has now.
    const Triangle& vertices(std::uint32_t triangle) const { return vertex_[triangle]; }

    /// The normal that a triangle came with; twice its area long.
    const glm::dvec3& firstNormal(std::uint32_t triangle) const { return firstNormal_[triangle]; }

    /// The edge from a corner to the next one of its triangle, as it came.
    EdgeKind firstEdge(std::uint32_t corner) const { return firstEdge_[corner]; }

    /// Whether an open edge came with `p`, or with a position that has gone into it; edges between groups do not count.
    bool isBorder(std::uint32_t p) const { return isBorder_[p] != 0; }

    /// Calls `visit(corner)` for the corners of living triangles at `p`.
    template <class Visit>
    void forCorners(std::uint32_t p, Visit visit);

    /// Each position that shares a living triangle with `p`, once, in the order of the walk. Valid until the next call.
    std::span<const std::uint32_t> neighbours(std::uint32_t p);

    bool hasFaces(std::uint32_t p);

    /// How many positions share a living triangle both with `a` and with `b`, these two aside.
    std::size_t commonNeighbours(std::uint32_t a, std::uint32_t b);

    /// Where what was `p` is now.
    std::uint32_t whereNow(std::uint32_t p) const {
        while (movedTo_[p] != p)
            p = movedTo_[p];
        return p;
    }

    bool isInPlace(std::uint32_t p) const { return movedTo_[p] == p; }

    /// Where the position of another piece is now that was nearest to `p`; kNone if no other piece matters to it.
    std::uint32_t partner(std::uint32_t p) const {
        return partner_.empty() || partner_[p] == hierarchy::kNone ? hierarchy::kNone : whereNow(partner_[p]);
    }

    void remove(std::uint32_t triangle) {
        isAlive_[triangle] = 0;
        --alive_;
    }

    /// Gives a corner another vertex, at the position `p`.
    void change(std::uint32_t corner, std::uint32_t vertex, std::uint32_t p) {
        vertex_[corner / 3][corner % 3] = vertex;
        position_[corner / 3][corner % 3] = p;
    }

    /// Hands all that `from` has on to `to`: its corners, its border and its partner.
    void join(std::uint32_t from, std::uint32_t to);

    /// Has `whereNow` lead from `p` to `q`.
    void sendTo(std::uint32_t p, std::uint32_t q) { movedTo_[p] = q; }

    struct Doubled {
        std::uint32_t kept;
        std::uint32_t gone;
    };

    /// The triangles at `p` that have the same three positions as another one, without those at a locked edge, which
    /// keeps its faces. Valid until the next call.
    std::span<const Doubled> doubled(std::uint32_t p);

private:
    /// The places of a triangle that follow one of them.
    static constexpr std::array<std::array<std::uint32_t, 2>, 3> kOthers = {{{1, 2}, {2, 0}, {0, 1}}};

    /// What the triangles around one position have at an edge from there; kept by the position at its other end.
    struct Spoke {
        std::uint32_t seenFrom = hierarchy::kNone; // that one position: the rest is of it alone
        std::uint32_t triangles = 0;
        std::uint64_t first = 0;   // the two vertices of the first triangle
        std::uint64_t differs = 0; // bits in which those of another one differ from them
    };

    void linkCorners();
    void gatherSpokes(std::uint32_t a, std::vector<Spoke>& spokes) const;
    void findEdges();
    bool hasEqualSides() const;

    const Patch& patch_;
    std::vector<Triangle> position_;
    std::vector<Triangle> vertex_;
    std::vector<glm::dvec3> firstNormal_;
    std::vector<EdgeKind> firstEdge_; // per corner
    std::vector<std::uint8_t> isAlive_;
    std::size_t alive_ = 0;
    std::vector<std::uint32_t> head_; // per position: its first corner
    std::vector<std::uint32_t> tail_; // its last, if there is one
    std::vector<std::uint32_t> next_; // per corner
    std::vector<std::uint8_t> isBorder_;
    std::vector<std::uint32_t> partner_; // as it came; empty if the patch is one piece
    std::vector<std::uint32_t> movedTo_;
    std::vector<std::uint32_t> stamp_; // per position
    std::uint32_t stampNow_ = 0;
    std::vector<std::array<std::uint32_t, 3>> sides_; // of the triangles at a position: lesser, greater, triangle
    std::vector<Doubled> doubled_;
    std::vector<std::uint32_t> neighbours_; // room for all positions and one more
};

template <class Visit>
void LivingPatch::forCorners(std::uint32_t p, Visit visit) {
    std::uint32_t last = hierarchy::kNone;
    for (std::uint32_t corner = head_[p]; corner != hierarchy::kNone; corner = next_[corner]) {
        if (isAlive_[corner / 3] == 0) {
            (last == hierarchy::kNone ? head_[p] : next_[last]) = next_[corner];
            continue;
        }
        last = corner;
        visit(corner);
    }
    tail_[p] = last;
}

inline std::span<const std::uint32_t> LivingPatch::neighbours(std::uint32_t p) {
    const std::uint32_t stamp = ++stampNow_;
    stamp_[p] = stamp;
    std::size_t count = 0;
    std::uint32_t* const list = neighbours_.data();
    std::uint32_t* const stamps = stamp_.data();
    forCorners(p, [&](std::uint32_t corner) {
        const Triangle& t = position_[corner / 3];
        for (const std::uint32_t place : kOthers[corner % 3]) {
            const std::uint32_t q = t[place];
            list[count] = q; // without a branch: nothing tells beforehand who was seen
            count += stamps[q] != stamp ? 1 : 0;
            stamps[q] = stamp;
        }
    });
    return std::span(neighbours_).first(count);
}

inline bool LivingPatch::hasFaces(std::uint32_t p) {
    std::uint32_t& head = head_[p];
    while (head != hierarchy::kNone && isAlive_[head / 3] == 0)
        head = next_[head];
    return head != hierarchy::kNone;
}

} // namespace gnomon::simplify
