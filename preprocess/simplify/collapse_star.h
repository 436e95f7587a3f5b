// The star of a half-edge collapse: the triangles around the removed position. The class also tests whether the
// collapse is valid.
#pragma once

#include "preprocess/simplify/fan_map.h"
#include "preprocess/simplify/simplification_mesh.h"

#include <span>

namespace gnomon::simplify {

/// A triangle of the star. One of its corners is the removed position, which is the centre of the star.
struct StarFace {
    std::uint32_t triangle;
    std::uint32_t b; // `b` and `c` are the other two corner positions, in order
    std::uint32_t c;
};

/// The triangles around the removed position of one collapse at a time. The test results are valid until `mesh`
/// changes.
class CollapseStar {
public:
    CollapseStar(const Patch& patch, SimplificationMesh& mesh) : patch_(patch), mesh_(mesh) {}

    /// Gathers the triangles around `from` for a collapse of position `from` onto position `to`. `to` must have
    /// triangles.
    void gather(std::uint32_t from, std::uint32_t to);

    std::uint32_t from() const { return from_; }

    std::uint32_t to() const { return to_; }

    std::span<const StarFace> faces() const { return faces_; }

    /// Returns true if the collapse removes `face`, because `face` contains `to` and becomes degenerate. In the other
    /// faces `to` replaces `from`.
    bool vanishes(const StarFace& face) const { return face.b == to_ || face.c == to_; }

    /// Returns the number of triangles that the collapse removes.
    std::size_t vanishingCount() const { return vanishing_; }

    /// Returns true if the collapse would turn the normal of a remaining triangle by more than 75 degrees, or to the
    /// opposite side of the triangle's original normal.
    bool turnsFace() const;

    /// Returns true if the collapse would change the topology of the mesh. This is the link condition (Dey,
    /// Edelsbrunner, Guha, Nekhayev, "Topology Preserving Edge Contraction", 1999). It is violated in three cases:
    /// - `from` and `to` have common neighbours outside the vanishing triangles,
    /// - both positions are on a border but their edge is not,
    /// - the positions have no common edge.
    bool violatesLinkCondition();

    /// Returns true if the collapse would add a triangle to an edge between two locked positions, or remove a triangle
    /// from it. The neighbouring group shares this edge and relies on its triangles.
    bool breaksLockedEdge();

    /// Orders the triangles of the star around its centre, beginning at `to`, and writes them to `fan`. Triangle i of
    /// the fan is then face i of the star. Returns false if the triangles do not form a fan.
    bool orderAsFan(Fan& fan);

    /// Applies the collapse to the mesh. `to` replaces `from` in the remaining faces, and the vanishing faces are
    /// removed.
    void apply();

private:
    std::uint32_t replacementOf(std::uint32_t vertex);

    const Patch& patch_;
    SimplificationMesh& mesh_;
    std::uint32_t from_ = hierarchy::kNone;
    std::uint32_t to_ = hierarchy::kNone;
    std::vector<StarFace> faces_;
    std::size_t vanishing_ = 0;
    // For each locked edge at the centre, the neighbour position, and 1 if the collapse removes the face there.
    std::vector<std::array<std::uint32_t, 2>> ends_;
    std::vector<std::array<std::uint32_t, 2>> replacements_; // pairs: a vertex at `from`, its replacement at `to`
};

} // namespace gnomon::simplify
