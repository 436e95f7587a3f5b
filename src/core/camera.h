// The camera: its eye and target in right-handed world space, and the axes of its left-handed camera space.
#pragma once

#include "core/words.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon {

/// The type of projection: perspective, or orthographic with parallel primary rays. An orthographic image covers the
/// same area at every depth. This is the area that the perspective image covers at the depth of the target. An
/// orthographic image also shows surfaces behind the eye.
enum class Projection : std::uint8_t { Perspective, Orthographic };
inline constexpr std::array kProjections = {
    Word<Projection>{Projection::Perspective, "perspective"},
    Word<Projection>{Projection::Orthographic, "orthographic"},
};

/// A camera: eye, target and projection in right-handed world space. Angles are in radians.
struct Camera {
    glm::dvec3 eye{0, 0, 0};
    glm::dvec3 target{0, 0, -1};
    glm::dvec3 up{0, 1, 0};
    double fovYRadians = 1.0471975511965976; // full vertical angle, in the open interval (0, pi)
    Projection projection = Projection::Perspective;

    /// Returns true if the projection is orthographic, so that all primary rays are parallel.
    bool isParallel() const { return projection == Projection::Orthographic; }

    bool operator==(const Camera&) const = default;
};

/// Returns half the height of the area that the image of `camera` covers at the depth of the target, in world units.
double halfHeightAtTarget(const Camera& camera);

/// The orthonormal axes of camera space, in world coordinates. Because right x up = -view, camera space (right, up,
/// view) is LEFT-handed. The eye is at 0 and looks along +z, as in Lloyd et al. 2006.
struct CameraBasis {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 view{0, 0, -1};
};

/// Returns the axes of camera space for `camera`. If `up` is parallel to the view direction, the world axis with the
/// smallest component along the view direction replaces `up`. Throws Error if eye and target are the same point or if a
/// coordinate is not finite.
CameraBasis cameraBasis(const Camera& camera);

/// Transforms a direction or an eye-relative position from world space to camera space.
glm::dvec3 toCamera(const CameraBasis& basis, const glm::dvec3& vector);

/// Transforms a direction or an eye-relative position from camera space to world space.
glm::dvec3 toWorld(const CameraBasis& basis, const glm::dvec3& vector);

} // namespace gnomon
