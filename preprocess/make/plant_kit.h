// What every unit of the plant is fitted out with: gratings, rails, ladders, stairs, pipes, valves, fences.
#pragma once

#include "core/random.h"
#include "preprocess/make/parts.h"

namespace gnomon::make {

inline const glm::dvec3 kUp(0, 1, 0);

/// Where the i-th of n things stands between 0 and 1.
inline double share(std::uint64_t i, std::uint64_t n) {
    return static_cast<double>(i) / static_cast<double>(n);
}

/// How finely the plant is made: 1 is about a million triangles. Larger means more parts and rounder ones.
class Detail {
public:
    explicit Detail(double level);

    double level() const { return level_; }

    /// A number of things of which there are `base` at level 1; at least `least`, at most `most`.
    std::uint64_t amount(double base, std::uint64_t least = 1, std::uint64_t most = 1U << 20U) const;

    /// Sides of a round thing of `radius` metres: 3 to 256.
    std::uint64_t sides(double radius) const;

    /// Steps of a bend.
    std::uint64_t bend() const;

private:
    double level_;
    double growth_; // level^(3/4): the rest of the growth goes into roundness
};

/// What a unit is built with: where its parts go, how finely, and its own random numbers.
struct Site {
    PartSink& parts;
    const Detail& detail;
    Random random{0};
};

/// A floor of flat bars over the rectangle [min.x, max.x] x [min.z, max.z] at height min.y.
void addGrating(Site& site, const glm::dvec3& min, const glm::dvec3& max);

/// Posts and rails from `a` to `b`, 1.1 m high.
void addHandrail(Site& site, const glm::dvec3& a, const glm::dvec3& b);

/// Handrails around a rectangle at height min.y.
void addHandrails(Site& site, const glm::dvec3& min, const glm::dvec3& max);

/// A ladder with rungs at `foot`, `height` high, against a wall behind -z; caged above 3 m.
void addLadder(Site& site, const glm::dvec3& foot, double height);

/// A flight of stairs from `foot` to `head`, 0.9 m wide, with stringers and rails.
void addStairs(Site& site, const glm::dvec3& foot, const glm::dvec3& head);

/// A pipe through `corners` (right angles) with flanges at its ends.
void addPipe(Site& site, std::span<const glm::dvec3> corners, double radius);

/// A flange with bolts at `center`.
void addFlange(Site& site, const glm::dvec3& center, const glm::dvec3& axis, double radius);

/// A valve with a hand wheel on top, in a pipe along `axis`.
void addValve(Site& site, const glm::dvec3& center, const glm::dvec3& axis, double radius);

/// A motor and a pump on a plinth, along x.
void addPump(Site& site, const glm::dvec3& foot, double size);

/// A vessel from `a` to `b` with dished ends.
void addVessel(Site& site, const glm::dvec3& a, const glm::dvec3& b, double radius);

/// A rectangle of sheet metal with pressed ridges: a fin, a louvre, a packing.
void addRidgedSheet(
    Site& site, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, Sides sides = Sides::One);

/// A fence from `a` to `b`, 2.2 m high: posts, wires and a mesh of flat bars.
void addFence(Site& site, const glm::dvec3& a, const glm::dvec3& b);

/// A wall of corrugated sheets from `corner` along `u` and `v`, each sheet written for both sides.
void addCladding(Site& site, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, double sheetWidth);

/// A street lamp at `foot` whose arm points along x.
void addLamp(Site& site, const glm::dvec3& foot);

} // namespace gnomon::make
