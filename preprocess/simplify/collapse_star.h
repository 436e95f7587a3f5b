// The star of a half-edge collapse: the triangles around the removed position, with the tests that reject the collapse.
#pragma once

#include "preprocess/simplify/fan_map.h"
#include "preprocess/simplify/simplification_mesh.h"

#include <span>

namespace gnomon::simplify {

/// A triangle of the star.
struct StarFace {
    std::uint32_t triangle;
    std::uint32_t b; // the two positions other than the star's centre, in order
    std::uint32_t c;
};

/// The star of one collapse at a time. The tests are valid for `mesh` at the time of `gather`.
class CollapseStar {
public:
    CollapseStar(const Patch& patch, SimplificationMesh& mesh) : patch_(patch), mesh_(mesh) {}

    /// Gathers the star for a collapse of `from` onto `to`. `to` must have faces.
    void gather(std::uint32_t from, std::uint32_t to);

    std::uint32_t from() const { return from_; }

    std::uint32_t to() const { return to_; }

    std::span<const StarFace> faces() const { return faces_; }

    /// Returns true if the collapse makes a face of the star degenerate. Such a face is removed. The other faces get
    /// `to` in the place of `from`.
    bool vanishes(const StarFace& face) const { return face.b == to_ || face.c == to_; }

    /// Returns the number of faces of the star that vanish.
    std::size_t vanishingCount() const { return vanishing_; }

    /// Returns true if the normal of a remaining face would turn by more than 75 degrees, or to the opposite side of
    /// its original normal.
    bool turnsFace() const;

    /// Returns true if the collapse would change the topology. This is true if `from` and `to` have common neighbours
    /// outside the vanishing triangles, if both are on a border but their edge is not, or if they have no edge. This is
    /// the link condition (Dey, Edelsbrunner, Guha, Nekhayev, "Topology Preserving Edge Contraction", 1999).
    bool violatesLinkCondition();

    /// Returns true if an edge between two locked positions would gain or lose a face. The neighbouring group relies on
    /// these faces.
    bool breaksLockedEdge();

    /// Orders the faces edge to edge from `to` onwards and writes the shape of `fan`, where old triangle i is face i.
    /// Returns false if the star is not a fan.
    bool orderAsFan(Fan& fan);

    /// Applies the collapse to the mesh: `to` replaces `from` in the remaining faces, and the vanishing faces are
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
    // Ends of locked edges: neighbour, and 1 if the face there vanishes.
    std::vector<std::array<std::uint32_t, 2>> ends_;
    std::vector<std::array<std::uint32_t, 2>> replacements_; // a vertex at `from`, and its replacement at `to`
};

} // namespace gnomon::simplify
