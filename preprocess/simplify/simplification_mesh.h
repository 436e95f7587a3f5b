// The mesh that edge collapses modify. It contains the remaining triangles of a patch, lists of the triangles at each
// position, and the target of each collapsed position.
#pragma once

#include "preprocess/simplify/patch.h"

#include <span>

namespace gnomon::simplify {

/// The kind of an edge before the simplification. Open: only one triangle has the edge. Crease: the triangles have
/// different vertices at the edge (a seam). Smooth: the triangles share the vertices of the edge.
enum class EdgeKind : std::uint8_t { Open, Crease, Smooth };

/// A triangle mesh for edge collapses. Each triangle has the same index as in the original patch. Corner i of triangle
/// t has the index 3 t + i. The corners at a position form a linked list. A traversal of this list removes the corners
/// of deleted triangles, so traversals are not const.
class SimplificationMesh {
public:
    explicit SimplificationMesh(const Patch& patch);

    std::size_t triangleCount() const { return triangleCount_; }

    /// Returns true if a collapse or `remove` has deleted the triangle.
    bool isRemoved(std::uint32_t triangle) const { return isRemoved_[triangle] != 0; }

    /// Returns the current corner positions of a triangle.
    const Triangle& positions(std::uint32_t triangle) const { return position_[triangle]; }

    /// Returns the current corner vertices of a triangle.
    const Triangle& vertices(std::uint32_t triangle) const { return vertex_[triangle]; }

    /// Returns the normal that a triangle had before all collapses. The length of the normal is twice the area of the
    /// triangle.
    const glm::dvec3& originalNormal(std::uint32_t triangle) const { return originalNormal_[triangle]; }

    /// Returns the kind that an edge had before all collapses. The edge goes from `corner` to the next corner of its
    /// triangle.
    EdgeKind originalEdge(std::uint32_t corner) const { return originalEdge_[corner]; }

    /// Returns true if position `p`, or a position merged into it, had an open edge in the original patch. Edges
    /// between two groups do not count as open.
    bool isBorder(std::uint32_t p) const { return isBorder_[p] != 0; }

    /// Calls `visit(corner)` for each triangle corner at position `p`. Skips deleted triangles.
    template <class Visit>
    void forEachCorner(std::uint32_t p, Visit visit);

    /// Returns all neighbour positions of `p`, which share a triangle with it. Each neighbour occurs once, in the order
    /// of the corner list. The result is valid until the next call.
    std::span<const std::uint32_t> neighbours(std::uint32_t p);

    /// Returns true if at least one triangle at position `p` is not deleted.
    bool hasTriangles(std::uint32_t p);

    /// Returns the number of common neighbours of positions `a` and `b`. A common neighbour shares a triangle with `a`
    /// and a triangle with `b`. `a` and `b` themselves do not count.
    std::size_t commonNeighbours(std::uint32_t a, std::uint32_t b);

    /// Returns the position that `p` was merged into, directly or through other positions. Returns `p` itself if it was
    /// not merged. The merged positions form a union-find tree.
    std::uint32_t representative(std::uint32_t p) const {
        while (mergedInto_[p] != p)
            p = mergedInto_[p];
        return p;
    }

    /// Returns true if position `p` was not merged into another position.
    bool isRepresentative(std::uint32_t p) const { return mergedInto_[p] == p; }

    /// Returns the current position of the partner of `p`. A partner is a nearby position of another component
    /// (vertex_pairs.h), or the position that it was merged into. Returns kNone if `p` has no partner.
    std::uint32_t pairedWith(std::uint32_t p) const {
        return pair_.empty() || pair_[p] == hierarchy::kNone ? hierarchy::kNone : representative(pair_[p]);
    }

    /// Marks a triangle as deleted. Later traversals remove its corners from their lists.
    void remove(std::uint32_t triangle) {
        isRemoved_[triangle] = 1;
        --triangleCount_;
    }

    /// Replaces the vertex of a triangle corner. The new vertex is at position `p`.
    void setCorner(std::uint32_t corner, std::uint32_t vertex, std::uint32_t p) {
        vertex_[corner / 3][corner % 3] = vertex;
        position_[corner / 3][corner % 3] = p;
    }

    /// Merges position `from` into `to`. `to` receives the triangle corners and the border flag of `from`. If `to` has
    /// no vertex pair, it also receives the pair of `from`.
    void merge(std::uint32_t from, std::uint32_t to);

    /// Changes the target of the merged position `p` to position `q`.
    void redirect(std::uint32_t p, std::uint32_t q) { mergedInto_[p] = q; }

    /// Two triangles with the same three corner positions.
    struct Duplicate {
        std::uint32_t kept;
        std::uint32_t removed;
    };

    /// Returns the triangles at `p` that have the same three corner positions as an earlier triangle. Triangles at an
    /// edge between two locked positions are excluded, because such an edge must keep all of its triangles. The result
    /// is valid until the next call.
    std::span<const Duplicate> duplicates(std::uint32_t p);

private:
    /// For each corner of a triangle, the numbers of the other two corners in order.
    static constexpr std::array<std::array<std::uint32_t, 2>, 3> kOthers = {{{1, 2}, {2, 0}, {0, 1}}};

    /// The triangles that share one edge from a position. The object is stored with the position at the other end of
    /// the edge.
    struct Spoke {
        std::uint32_t seenFrom = hierarchy::kNone; // the first end; other members are valid only for it
        std::uint32_t triangles = 0;
        std::uint64_t first = 0;   // the two vertices of the first triangle
        std::uint64_t differs = 0; // the bits in which vertices of another triangle differ from `first`
    };

    void linkCorners();
    void gatherSpokes(std::uint32_t a, std::vector<Spoke>& spokes) const;
    void findEdges();
    bool hasEqualOppositeEdges() const;

    const Patch& patch_;
    std::vector<Triangle> position_;
    std::vector<Triangle> vertex_;
    std::vector<glm::dvec3> originalNormal_;
    std::vector<EdgeKind> originalEdge_; // kind of the edge from each corner to the next
    std::vector<std::uint8_t> isRemoved_;
    std::size_t triangleCount_ = 0;
    std::vector<std::uint32_t> head_; // per position: the first corner in its list
    std::vector<std::uint32_t> tail_; // per position: the last corner in its list, if any
    std::vector<std::uint32_t> next_; // per corner: the next corner in the list
    std::vector<std::uint8_t> isBorder_;
    std::vector<std::uint32_t> pair_; // per position: its partner from vertexPairs, or kNone
    std::vector<std::uint32_t> mergedInto_;
    std::vector<std::uint32_t> stamp_; // per position: the last query that visited it
    std::uint32_t stampNow_ = 0;
    std::vector<std::array<std::uint32_t, 3>>
        // per triangle at a position: the lower and the higher end of the edge opposite the position, and the triangle
        oppositeEdges_;
    std::vector<Duplicate> duplicates_;
    std::vector<std::uint32_t> neighbours_; // buffer with space for all positions and one more
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
            list[count] = q; // no branch, because the CPU cannot predict whether q is new
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
