// Computes the default view of a model: a camera whose picture the model fills.
#pragma once

#include "core/camera.h"
#include "core/words.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::path {

/// The side from which a camera sees a model. Iso looks along the diagonal of a cube, from the front, the right and
/// above.
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

/// Returns the direction towards the eye, and the up direction in the picture, of a camera that sees the model from
/// `side`. `up` is the up direction of the world. Without a side, returns a three-quarter view of the front from
/// slightly above, on the side of the default light.
Vantage vantageOf(const std::optional<ViewSide>& side, const glm::dvec3& up);

/// Returns the direction towards the default light, which comes from above, the right and the front. It is (0.4, 1,
/// 0.3) if `up` is the y axis.
glm::dvec3 usualLight(const glm::dvec3& up);

/// The fraction of the picture's width or height, whichever is larger, that a model fills in a default view.
inline constexpr double kFramedPart = 0.875;

/// Returns a perspective camera at `vantage` that shows all `points` (at least one). They are centred in the picture
/// and fill the fraction kFramedPart of it. The fraction is smaller if the eye would be nearer to the points than a
/// fiftieth of their extent. The target is on the view axis at the vertical middle of the points, so that orbits look
/// natural. `aspect` is width / height, and `fovYRadians` is in (0, pi).
Camera framingCamera(std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

/// Returns an orthographic camera at `vantage` that shows all `points`, which fill the fraction kFramedPart of the
/// picture. All points are in front of the eye, and the target is their middle.
Camera orthographicFraming(
    std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians);

} // namespace gnomon::path
