// The star of a half-edge collapse: the triangles around the position that is removed, which of them degenerate, and
// the tests that forbid the collapse.
#pragma once

#include "preprocess/simplify/fan_map.h"
#include "preprocess/simplify/simplification_mesh.h"

#include <span>

namespace gnomon::simplify {

struct StarFace {
    std::uint32_t triangle;
    std::uint32_t b; // the two positions besides the star's centre, in order
    std::uint32_t c;
};

/// Holds the star of one collapse after the other; its tests hold for `mesh` as it was when the star was gathered.
class CollapseStar {
public:
    CollapseStar(const Patch& patch, SimplificationMesh& mesh) : patch_(patch), mesh_(mesh) {}

    /// Considers moving `from` onto `to`, which has faces.
    void gather(std::uint32_t from, std::uint32_t to);

    std::uint32_t from() const { return from_; }

    std::uint32_t to() const { return to_; }

    std::span<const StarFace> faces() const { return faces_; }

    /// Whether the collapse makes a face of the star degenerate, so that it is removed; the others get `to` in the
    /// place of `from`.
    bool vanishes(const StarFace& face) const { return face.b == to_ || face.c == to_; }

    /// How many faces of the star vanish.
    std::size_t vanishingCount() const { return vanishing_; }

    /// Whether the normal of a face that stays would turn by more than 75 degrees, or to the other side of its
    /// original.
    bool turnsFace() const;

    /// Whether the collapse would change the topology: the two ends have common neighbours besides those of the
    /// triangles that vanish, or both are on a border but their edge is not, or they have no edge. The link condition:
    /// Dey, Edelsbrunner, Guha and Nekhayev, "Topology Preserving Edge Contraction", 1999.
    bool violatesLinkCondition();

    /// Whether an edge between two locked positions would gain or lose a face: the group on its other side relies on
    /// it.
    bool breaksLockedEdge();

    /// Orders the faces edge to edge from `to` onwards and writes the shape of `fan`, whose old triangle i is face i;
    /// false if the star is no fan.
    bool orderAsFan(Fan& fan);

    /// Carries the collapse out on the mesh: `to` takes the place of `from` in the faces that stay, the others are
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
    std::vector<std::array<std::uint32_t, 2>> ends_;         // of locked edges: neighbour, 1 if the face there vanishes
    std::vector<std::array<std::uint32_t, 2>> replacements_; // a vertex of `from`, and the one of `to` that replaces it
};

} // namespace gnomon::simplify
