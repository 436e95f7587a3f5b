// The mesh that edge collapses work on: the triangles that remain of a patch, linked around their positions, and what
// each collapsed position was merged into.
#pragma once

#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::simplify {

/// What the input patch has at an edge: no other triangle, or one with other vertices (a seam), or one with the same.
enum class EdgeKind : std::uint8_t { Open, Crease, Smooth };

/// Triangles keep their index in the patch; corner i of triangle t has the id 3 t + i. The corners at a position are a
/// linked list. Walks along it unlink the removed triangles that they meet, so they are not const.
class SimplificationMesh {
public:
    explicit SimplificationMesh(const Patch& patch);

    std::size_t triangleCount() const { return triangleCount_; }

    /// Whether a collapse or `remove` has taken the triangle out.
    bool isRemoved(std::uint32_t triangle) const { return isRemoved_[triangle] != 0; }

    /// The current positions of a triangle.
    const Triangle& positions(std::uint32_t triangle) const { return position_[triangle]; }

    /// The current vertices of a triangle.
    const Triangle& vertices(std::uint32_t triangle) const { return vertex_[triangle]; }

    /// The normal of a triangle before any collapse; twice its area long.
    const glm::dvec3& originalNormal(std::uint32_t triangle) const { return originalNormal_[triangle]; }

    /// The edge from a corner to the next one of its triangle, before any collapse.
    EdgeKind originalEdge(std::uint32_t corner) const { return originalEdge_[corner]; }

    /// Whether `p`, or a position merged into it, had an open edge in the patch; edges between groups do not count.
    bool isBorder(std::uint32_t p) const { return isBorder_[p] != 0; }

    /// Calls `visit(corner)` for the corners of remaining triangles at `p`.
    template <class Visit>
    void forEachCorner(std::uint32_t p, Visit visit);

    /// Each position that shares a remaining triangle with `p`, once, in the order of the walk. Valid until the next
    /// call.
    std::span<const std::uint32_t> neighbours(std::uint32_t p);

    /// Whether any triangle remains at `p`.
    bool hasTriangles(std::uint32_t p);

    /// How many positions share a remaining triangle both with `a` and with `b`, these two aside.
    std::size_t commonNeighbours(std::uint32_t a, std::uint32_t b);

    /// The position that `p` has been merged into, itself while it has not (the root of a union-find tree).
    std::uint32_t representative(std::uint32_t p) const {
        while (mergedInto_[p] != p)
            p = mergedInto_[p];
        return p;
    }

    /// Whether `p` has not been merged into another position.
    bool isRepresentative(std::uint32_t p) const { return mergedInto_[p] == p; }

    /// The representative of the other end of the vertex pair of `p` (vertex_pairs.h); kNone if it has none.
    std::uint32_t pairedWith(std::uint32_t p) const {
        return pair_.empty() || pair_[p] == hierarchy::kNone ? hierarchy::kNone : representative(pair_[p]);
    }

    /// Takes a triangle out; its corners are unlinked by the next walks.
    void remove(std::uint32_t triangle) {
        isRemoved_[triangle] = 1;
        --triangleCount_;
    }

    /// Gives a corner another vertex, at the position `p`.
    void setCorner(std::uint32_t corner, std::uint32_t vertex, std::uint32_t p) {
        vertex_[corner / 3][corner % 3] = vertex;
        position_[corner / 3][corner % 3] = p;
    }

    /// Merges `from` into `to`: its corners, its border flag and, where `to` has none, its vertex pair.
    void merge(std::uint32_t from, std::uint32_t to);

    /// Makes `q` what `p` has been merged into.
    void redirect(std::uint32_t p, std::uint32_t q) { mergedInto_[p] = q; }

    /// Two triangles of the same three positions.
    struct Duplicate {
        std::uint32_t kept;
        std::uint32_t removed;
    };

    /// The triangles at `p` that have the same three positions as an earlier one, except those on a locked edge, which
    /// keeps all its triangles. Valid until the next call.
    std::span<const Duplicate> duplicates(std::uint32_t p);

private:
    /// The places of a triangle that follow one of them.
    static constexpr std::array<std::array<std::uint32_t, 2>, 3> kOthers = {{{1, 2}, {2, 0}, {0, 1}}};

    /// What the triangles around one position have at an edge from there; stored at the other end of the edge.
    struct Spoke {
        std::uint32_t seenFrom = hierarchy::kNone; // that one position; the other fields are valid for it alone
        std::uint32_t triangles = 0;
        std::uint64_t first = 0;   // the two vertices of the first triangle
        std::uint64_t differs = 0; // bits in which those of another one differ from them
    };

    void linkCorners();
    void gatherSpokes(std::uint32_t a, std::vector<Spoke>& spokes) const;
    void findEdges();
    bool hasEqualOppositeEdges() const;

    const Patch& patch_;
    std::vector<Triangle> position_;
    std::vector<Triangle> vertex_;
    std::vector<glm::dvec3> originalNormal_;
    std::vector<EdgeKind> originalEdge_; // per corner
    std::vector<std::uint8_t> isRemoved_;
    std::size_t triangleCount_ = 0;
    std::vector<std::uint32_t> head_; // per position: its first corner
    std::vector<std::uint32_t> tail_; // its last, if there is one
    std::vector<std::uint32_t> next_; // per corner
    std::vector<std::uint8_t> isBorder_;
    std::vector<std::uint32_t> pair_; // per position, as in vertexPairs
    std::vector<std::uint32_t> mergedInto_;
    std::vector<std::uint32_t> stamp_; // per position
    std::uint32_t stampNow_ = 0;
    std::vector<std::array<std::uint32_t, 3>>
        oppositeEdges_; // of the triangles at a position: lesser, greater, triangle
    std::vector<Duplicate> duplicates_;
    std::vector<std::uint32_t> neighbours_; // room for all positions and one more
};

template <class Visit>
void SimplificationMesh::forEachCorner(std::uint32_t p, Visit visit) {
    std::uint32_t last = hierarchy::kNone;
    for (std::uint32_t corner = head_[p]; corner != hierarchy::kNone; corner = next_[corner]) {
        if (isRemoved_[corner / 3] != 0) {
            (last == hierarchy::kNone ? head_[p] : next_[last]) = next_[corner];
            continue;
        }
        last = corner;
        visit(corner);
    }
    tail_[p] = last;
}

inline std::span<const std::uint32_t> SimplificationMesh::neighbours(std::uint32_t p) {
    const std::uint32_t stamp = ++stampNow_;
    stamp_[p] = stamp;
    std::size_t count = 0;
    std::uint32_t* const list = neighbours_.data();
    std::uint32_t* const stamps = stamp_.data();
    forEachCorner(p, [&](std::uint32_t corner) {
        const Triangle& t = position_[corner / 3];
        for (const std::uint32_t place : kOthers[corner % 3]) {
            const std::uint32_t q = t[place];
            list[count] = q; // without a branch: whether q is new is unpredictable
            count += stamps[q] != stamp ? 1 : 0;
            stamps[q] = stamp;
        }
    });
    return std::span(neighbours_).first(count);
}

inline bool SimplificationMesh::hasTriangles(std::uint32_t p) {
    std::uint32_t& head = head_[p];
    while (head != hierarchy::kNone && isRemoved_[head / 3] != 0)
        head = next_[head];
    return head != hierarchy::kNone;
}

} // namespace gnomon::simplify
