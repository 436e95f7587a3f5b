// The default view of a model: the camera from which the model fills the picture.
#pragma once

#include "core/camera.h"
#include "core/words.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::path {

/// The side from which a model is seen. Iso looks along the diagonal of a cube, from the front, the right and above.
enum class ViewSide : std::uint8_t { Front, Back, Left, Right, Top, Bottom, Iso };
inline constexpr std::array kViewSides = {
    Word<ViewSide>{ViewSide::Front, "front"},
    Word<ViewSide>{ViewSide::Back, "back"},
    Word<ViewSide>{ViewSide::Left, "left"},
    Word<ViewSide>{ViewSide::Right, "right"},
    Word<ViewSide>{ViewSide::Top, "top"},
    Word<ViewSide>{ViewSide::Bottom, "bottom"},
    Word<ViewSide>{ViewSide::Iso, "iso"},
};

/// Two unit directions, in world space.
struct Vantage {
    glm::dvec3 from{0, 0, 1}; // towards the eye
    glm::dvec3 up{0, 1, 0};   // up in the picture: perpendicular to `from`, or the world's up direction
};

/// Returns the vantage of a side, in a world with the given up direction. Without a side, returns a three-quarter view
/// of the front from slightly above, on the side of the default light.
Vantage vantageOf(const std::optional<ViewSide>& side, const glm::dvec3& up);

/// Returns the direction towards the default light: from above, the right and the front. It is 0.4,1,0.3 if `up` is y.
glm::dvec3 usualLight(const glm::dvec3& up);

/// The part of the picture's width or height that a framed model fills, whichever is larger.
inline constexpr double kFramedPart = 0.875;

/// Returns the perspective camera at `vantage` whose picture shows `points` (at least one) centred, with the size
/// kFramedPart. The model is smaller if the eye would be nearer to the points than a fiftieth of their extent. The
/// target is the point of the view axis at the points' vertical middle, so that orbits look natural. `aspect` is width
/// / height, `fovYRadians` is in (0, pi).
Camera framingCamera(std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

/// Returns the orthographic camera at `vantage` whose picture shows `points` with the size kFramedPart. The points are
/// in front of the eye, and the target is the middle of the points.
Camera orthographicFraming(
    std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

} // namespace gnomon::path
