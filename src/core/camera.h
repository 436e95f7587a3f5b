// The view: an eye in right-handed world space, and the left-handed camera space of the shadow theory.
#pragma once

#include "core/words.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon {

/// How lines of sight run: from the eye, or side by side along the view. An orthographic picture shows at every depth
/// as much as a perspective one shows at the target, and what lies behind the eye too.
enum class Projection : std::uint8_t { Perspective, Orthographic };
inline constexpr std::array kProjections = {
    Word<Projection>{Projection::Perspective, "perspective"},
    Word<Projection>{Projection::Orthographic, "orthographic"},
};

/// A view of the world. World space is right-handed; angles in radians.
struct Camera {
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 target{0, 0, -1};
    glm::dvec3 up{0, 1, 0};
    double fovYRadians = 1.0471975511965976; // full vertical angle, in (0, pi)
    Projection projection = Projection::Perspective;

    /// Whether the lines of sight are parallel.
    bool isParallel() const { return projection == Projection::Orthographic; }

    bool operator==(const Camera&) const = default;
};

/// Half the height of what the picture of `camera` shows at the depth of its target, world units.
double halfHeightAtTarget(const Camera& camera);

/// The axes of camera space in world space: orthonormal, right x up = -view, so that camera space (right, up, view)
/// is LEFT-handed with the eye at 0 and the view along +z, as in Lloyd et al. 2006.
struct CameraBasis {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 view{0, 0, -1};
};

/// The basis of `camera`. An `up` parallel to the view is replaced by the world axis furthest from it; throws Error if
/// eye and target coincide or anything is not finite.
CameraBasis cameraBasis(const Camera& camera);

/// `vector`, a direction or an eye-relative position in world space, in camera space.
glm::dvec3 toCamera(const CameraBasis& basis, const glm::dvec3& vector);

/// `vector`, in camera space, as a direction or an eye-relative position in world space.
glm::dvec3 toWorld(const CameraBasis& basis, const glm::dvec3& vector);

} // namespace gnomon
