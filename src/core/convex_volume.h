// Convex volumes, which are intersections of half-spaces, and a conservative test of boxes against them.
#pragma once

#include "core/box.h"

#include <cmath>
#include <vector>

namespace gnomon {

/// The half-space of all points p with dot(normal, p) + offset >= 0. `normal` has unit length and points inward.
struct Plane {
    glm::dvec3 normal{0, 0, 1};
    double offset = 0;

    double signedDistance(const glm::dvec3& point) const { return glm::dot(normal, point) + offset; }

    bool operator==(const Plane&) const = default;
};

/// A convex volume: the points inside all planes. A volume without planes is the whole space.
struct ConvexVolume {
    std::vector<Plane> planes;
};

/// The position of a box relative to a convex volume or a half-space.
enum class Containment { Outside, Intersecting, Inside };

bool contains(const ConvexVolume& volume, const glm::dvec3& point);

/// A box with precomputed values for fast tests against many planes. The results `Outside` and `Inside` are certain.
/// For this purpose the test includes a bound of the rounding error that is valid for every rounding mode (Higham 2002,
/// section 3.1). All uncertain cases are `Intersecting`.
class BoxAgainstPlanes {
public:
    explicit BoxAgainstPlanes(const Box& box)
        : center_((box.min + box.max) * 0.5),
          half_((box.max - box.min) * 0.5),
          size_(std::abs(center_.x) + std::abs(center_.y) + std::abs(center_.z) + half_.x + half_.y + half_.z) {}

    /// Tests the box against the half-space dot(normal, p) + offset >= 0. The absolute components of `normal` are at
    /// most 1.
    Containment classify(const glm::dvec3& normal, double offset) const {
        const double reach = glm::dot(glm::abs(normal), half_);
        const double middle = glm::dot(normal, center_) + offset;
        const double rounding = kRounding * (size_ + std::abs(offset));
        if (middle < -reach - rounding) return Containment::Outside;
        return middle >= reach + rounding ? Containment::Inside : Containment::Intersecting;
    }

private:
    /// Bound of the rounding error of `classify`, relative to size_ + |offset|. Eleven operations lead from the corners
    /// of the box to the result. Each operation has an error of at most 2^-52 of its terms. The absolute values of
    /// these terms add up to at most twice size_ + |offset|.
    static constexpr double kRounding = 0x1p-47;

    glm::dvec3 center_;
    glm::dvec3 half_;
    double size_; // upper bound of the coordinates and of the half extents of the box
};

/// Tests `box` against `volume` conservatively. A box that intersects the volume is never `Outside`, but a box outside
/// the volume can be `Intersecting`.
Containment classify(const ConvexVolume& volume, const Box& box);

} // namespace gnomon
