// Computes the footprint of a shadow map texel at a point, by finite differences of the matrix that the shaders use.
// This code is independent of the functions that plan maps and bound their aliasing.
#pragma once

#include "render/backend.h"

namespace gnomon::validation {

/// Step of the finite differences divided by the width of a pixel. It is far smaller than a texel, and far larger than
/// the rounding error of doubles.
constexpr double kStepOverPixel = 1e-3;

/// The widths of a shadow map texel at a point, perpendicular to the light, in world units. They do not include the
/// slope of the receiver.
struct TexelWidths {
    double x = 0; // width along the x axis of light space
    double z = 0; // width along the z axis of light space, without shear
};

/// The footprint of a shadow map texel at a point, as two displacements perpendicular to the light in camera-relative
/// space, including shear.
struct TexelFootprint {
    glm::dvec3 column{0}; // displacement to the same position in the next column
    glm::dvec3 row{0};
};

/// Measures the widths and footprints of the texels of one shadow map.
class TexelProbe {
public:
    TexelProbe(const render::DrawInputs& frame, const shadow::ShadowMap& map);

    /// Returns the widths of the shadow map texel at `p` (camera-relative space). `step` is the step of the finite
    /// differences in world units. It must be much smaller than a texel.
    TexelWidths widths(const glm::dvec3& p, double step) const;

    TexelFootprint footprint(const glm::dvec3& p, double step) const;

private:
    struct Derivatives {
        glm::dvec2 byX{0}; // derivative of (column, row)
        glm::dvec2 byZ{0};
    };

    glm::dvec2 texel(const glm::dvec3& p) const;
    Derivatives derivatives(const glm::dvec3& p, double step) const;

    shadow::FloatMapImage image_; // the lookup parameters in floats, as uploaded
    glm::dvec3 x_;                // axes of the light frame in camera-relative space
    glm::dvec3 z_;
};

} // namespace gnomon::validation
