// A convex volume as the intersection of half-spaces, and the conservative test of a box against it.
#pragma once

#include "core/box.h"

#include <cmath>
#include <vector>

namespace gnomon {

/// The half-space of points p with dot(normal, p) + offset >= 0. `normal` has unit length and points inward.
struct Plane {
    glm::dvec3 normal{0, 0, 1};
    double offset = 0;

    double signedDistance(const glm::dvec3& point) const { return glm::dot(normal, point) + offset; }

    bool operator==(const Plane&) const = default;
};

/// The points inside every plane; no planes is all of space.
struct ConvexVolume {
    std::vector<Plane> planes;
};

/// How a box lies to a volume.
enum class Containment { Outside, Intersecting, Inside };

bool contains(const ConvexVolume& volume, const glm::dvec3& point);

/// A box, prepared for planes to be held against it. Three answers: `Outside` and `Inside` are certain, for they allow
/// for all that rounding can have done in any rounding mode (Higham 2002, section 3.1); the rest is `Intersecting`.
class BoxAgainstPlanes {
public:
    explicit BoxAgainstPlanes(const Box& box)
        : center_((box.min + box.max) * 0.5),
          half_((box.max - box.min) * 0.5),
          size_(std::abs(center_.x) + std::abs(center_.y) + std::abs(center_.z) + half_.x + half_.y + half_.z) {}

    /// `normal` has components of at most 1.
    Containment classify(const glm::dvec3& normal, double offset) const {
        const double reach = glm::dot(glm::abs(normal), half_);
        const double middle = glm::dot(normal, center_) + offset;
        const double rounding = kRounding * (size_ + std::abs(offset));
        if (middle < -reach - rounding) return Containment::Outside;
        return middle >= reach + rounding ? Containment::Inside : Containment::Intersecting;
    }

private:
    /// Eleven operations lie between the corners of the box and the answer, each off by at most 2^-52 of terms whose
    /// absolute values add up to no more than twice what this is a share of.
    static constexpr double kRounding = 0x1p-47;

    glm::dvec3 center_;
    glm::dvec3 half_;
    double size_; // no coordinate and no reach of the box is larger
};

/// Conservative: a box that touches the volume is never `Outside`; some that do not are `Intersecting`.
Containment classify(const ConvexVolume& volume, const Box& box);

} // namespace gnomon
