// One position about to go into another: the triangles around it, which of them vanish, and what speaks against it.
#pragma once

#include "preprocess/simplify/fan_map.h"
#include "preprocess/simplify/living_patch.h"

#include <span>

namespace gnomon::simplify {

struct StarFace {
    std::uint32_t triangle;
    std::uint32_t b; // the two positions besides the star's centre, in order
    std::uint32_t c;
};

/// The star of one collapse after the other; what it answers is true of `living` as it was when the star was gathered.
class CollapseStar {
public:
    CollapseStar(const Patch& patch, LivingPatch& living) : patch_(patch), living_(living) {}

    /// Considers moving `from` onto `to`, which has faces.
    void gather(std::uint32_t from, std::uint32_t to);

    std::uint32_t from() const { return from_; }

    std::uint32_t to() const { return to_; }

    std::span<const StarFace> faces() const { return faces_; }

    /// Whether the collapse takes a face of the star out; the others stay, with `to` in the place of `from`.
    bool vanishes(const StarFace& face) const { return face.b == to_ || face.c == to_; }

    /// How many faces of the star vanish.
    std::size_t vanishingCount() const { return vanishing_; }

    /// Whether a face that stays turns too far from how it is, or over from how it came.
    bool turnsFace() const;

    /// Whether the two ends have neighbours in common besides those of the triangles that vanish, or are both on a
    /// border across which the edge leads, or have no edge.
    bool changesTopology();

    /// Whether an edge between two locked positions would gain or lose a face: groups on its other side count on it.
    bool breaksLockedEdge();

    /// Orders the faces edge to edge from `to` onwards and writes the shape of `fan`, whose old triangle i is face i;
    /// false if the star is no fan.
    bool orderAsFan(Fan& fan);

    /// Puts `to` in the place of `from` into the faces that stay, and takes the others out.
    void carryOut();

private:
    std::uint32_t standIn(std::uint32_t vertex);

    const Patch& patch_;
    LivingPatch& living_;
    std::uint32_t from_ = hierarchy::kNone;
    std::uint32_t to_ = hierarchy::kNone;
    std::vector<StarFace> faces_;
    std::size_t vanishing_ = 0;
    std::vector<std::array<std::uint32_t, 2>> ends_;     // of locked edges: neighbour, 1 if the face there vanishes
    std::vector<std::array<std::uint32_t, 2>> standIns_; // a vertex of `from`, and what replaces it
};

} // namespace gnomon::simplify
