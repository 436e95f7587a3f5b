// From where a model is looked at where nobody says so, so that it fills the picture.
#pragma once

#include "core/camera.h"
#include "core/words.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::path {

/// The side from which a model is seen; Iso looks along the diagonal of a cube from the front, right and above.
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

/// Two directions of unit length, world space.
struct Vantage {
    glm::dvec3 from{0, 0, 1}; // towards the eye
    glm::dvec3 up{0, 1, 0};   // in the picture; across `from`, or the world's
};

/// The vantage of a side of a world in which `up` is up; of none a three-quarter view of the front from a little above,
/// on the side where the usual light comes from.
Vantage vantageOf(const std::optional<ViewSide>& side, const glm::dvec3& up);

/// The direction towards the light where nobody says so: from above, the right and the front of a world in which `up`
/// is up; 0.4,1,0.3 where this is y.
glm::dvec3 usualLight(const glm::dvec3& up);

/// What part of the picture's width or height a framed model fills, of that which it fills more.
inline constexpr double kFramedPart = 0.875;

/// The perspective camera at `vantage` in whose picture `points` (at least one) fill that part and lie in the middle,
/// both ways; less where the eye would come nearer to them than a fiftieth of their size. Its target lies where the
/// line of sight passes the points' vertical middle, so that one can turn about it. `aspect` is width by height,
/// `fovYRadians` in (0, pi).
Camera framingCamera(std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

/// Likewise by parallel lines of sight, which fill that part always. The points lie before the eye, and the target is
/// their middle.
Camera orthographicFraming(
    std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

} // namespace gnomon::path
