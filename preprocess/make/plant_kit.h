// Standard parts of the buildings and machines of the test plant, for example gratings, rails, ladders, stairs, pipes,
// valves and fences.
#pragma once

#include "core/random.h"
#include "preprocess/make/parts.h"

namespace gnomon::make {

/// The up axis of the test plant.
inline const glm::dvec3 kUp(0, 1, 0);

/// Returns the position i / n of element `i` of `n` evenly spaced elements. The result is in [0, 1).
inline double share(std::uint64_t i, std::uint64_t n) {
    return static_cast<double>(i) / static_cast<double>(n);
}

/// The level of detail of the test plant. Level 1 has about a million triangles. A higher level has more and rounder
/// parts.
class Detail {
public:
    explicit Detail(double level);

    double level() const { return level_; }

    /// Returns how many parts of one type exist at this level of detail. The number is `base` at level 1, and is
    /// clamped to `minAmount` and `maxAmount`.
    std::uint64_t amount(double base, std::uint64_t minAmount = 1, std::uint64_t maxAmount = 1U << 20U) const;

    /// Returns the number of sides, from 3 to 256, for a round part whose radius is given in metres.
    std::uint64_t sides(double radius) const;

    /// Returns the number of steps of each bend of a pipe.
    std::uint64_t bend() const;

private:
    double level_;
    double growth_; // level^(3/4), the factor for numbers of parts; the rest of the level increases roundness
};

/// What a function needs to create a building or machine of the plant: the receiver of its parts, the level of detail,
/// and random numbers.
struct Site {
    PartSink& parts;
    const Detail& detail;
    Random random{0};
};

/// Adds a floor of flat bars (grating). It covers the rectangle [min.x, max.x] x [min.z, max.z] at the height min.y.
void addGrating(Site& site, const glm::dvec3& min, const glm::dvec3& max);

/// Adds a handrail from `a` to `b`, made of posts and rails. Its height is 1.1 m.
void addHandrail(Site& site, const glm::dvec3& a, const glm::dvec3& b);

/// Adds handrails around the rectangle [min.x, max.x] x [min.z, max.z] at the height min.y.
void addHandrails(Site& site, const glm::dvec3& min, const glm::dvec3& max);

/// Adds a ladder with rungs at `foot`. It is `height` metres high, and its back is at a wall in the direction -z. A
/// ladder higher than 3 m has a safety cage.
void addLadder(Site& site, const glm::dvec3& foot, double height);

/// Adds a flight of stairs from `foot` to `head`, 0.9 m wide, with side beams (stringers) and rails.
void addStairs(Site& site, const glm::dvec3& foot, const glm::dvec3& head);

/// Adds a pipe through `corners` with flanges at its ends. All angles of the path must be right angles.
void addPipe(Site& site, std::span<const glm::dvec3> corners, double radius);

/// Adds a flange with bolts at `center`, for a pipe along `axis`.
void addFlange(Site& site, const glm::dvec3& center, const glm::dvec3& axis, double radius);

/// Adds a valve with a hand wheel on top, for a pipe along `axis`.
void addValve(Site& site, const glm::dvec3& center, const glm::dvec3& axis, double radius);

/// Adds a motor and a pump on a plinth. They are placed one after the other along x.
void addPump(Site& site, const glm::dvec3& foot, double size);

/// Adds a cylindrical vessel with dished ends from `a` to `b`.
void addVessel(Site& site, const glm::dvec3& a, const glm::dvec3& b, double radius);

/// Adds a rectangle of sheet metal with pressed ridges, for example for a fin, a louvre or a packing.
void addRidgedSheet(
    Site& site, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, Sides sides = Sides::One);

/// Adds a fence from `a` to `b`, 2.2 m high, made of posts, wires and a mesh of flat bars.
void addFence(Site& site, const glm::dvec3& a, const glm::dvec3& b);

/// Adds a wall of corrugated sheets that fills the rectangle from `corner` along `u` and `v`. Some sheets are
/// double-sided.
void addCladding(Site& site, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, double sheetWidth);

/// Adds a street lamp at `foot`, whose arm points along x.
void addLamp(Site& site, const glm::dvec3& foot);

} // namespace gnomon::make
