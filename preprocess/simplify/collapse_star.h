// The star of a half-edge collapse: the triangles around the removed position, with the tests that reject the collapse.
#pragma once

#include "preprocess/simplify/fan_map.h"
#include "preprocess/simplify/simplification_mesh.h"

#include <span>

namespace gnomon::simplify {

/// A triangle at the removed position, which is the centre of the star.
struct StarFace {
    std::uint32_t triangle;
    std::uint32_t b; // `b` and `c` are its other two positions, in order
    std::uint32_t c;
};

/// The star of one collapse at a time. The results of the tests are valid until `mesh` changes.
class CollapseStar {
public:
    CollapseStar(const Patch& patch, SimplificationMesh& mesh) : patch_(patch), mesh_(mesh) {}

    /// Gathers the triangles for a collapse of position `from` onto position `to`. `to` must have triangles.
    void gather(std::uint32_t from, std::uint32_t to);

    std::uint32_t from() const { return from_; }

    std::uint32_t to() const { return to_; }

    std::span<const StarFace> faces() const { return faces_; }

    /// Returns true if the collapse makes a face of the star degenerate, which means that the face contains `to`. Such
    /// a face is removed. In the other faces `to` replaces `from`.
    bool vanishes(const StarFace& face) const { return face.b == to_ || face.c == to_; }

    /// Returns the number of faces of the star that vanish.
    std::size_t vanishingCount() const { return vanishing_; }

    /// Returns true if the collapse would turn the normal of a remaining face by more than 75 degrees, or to the
    /// opposite side of the face's original normal.
    bool turnsFace() const;

    /// Returns true if the collapse would change the topology. This is the link condition (Dey, Edelsbrunner, Guha,
    /// Nekhayev, "Topology Preserving Edge Contraction", 1999). It is violated in three cases:
    /// - `from` and `to` have common neighbours outside the vanishing triangles,
    /// - both positions are on a border but their edge is not,
    /// - the positions have no common edge.
    bool violatesLinkCondition();

    /// Returns true if an edge between two locked positions would gain or lose a face. The neighbouring group relies on
    /// the faces at this edge.
    bool breaksLockedEdge();

    /// Orders the faces of the star around its centre, beginning at `to`, and writes them to `fan`. Old triangle i of
    /// the fan is face i. Returns false if the star is not a fan.
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
    // Ends of locked edges from the centre: the neighbour, and 1 if the face there vanishes.
    std::vector<std::array<std::uint32_t, 2>> ends_;
    std::vector<std::array<std::uint32_t, 2>> replacements_; // pairs of a vertex at `from` and its replacement at `to`
};

} // namespace gnomon::simplify
