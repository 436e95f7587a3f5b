// The texel of a shadow map at a point, from finite differences of the matrix that the map was drawn with, as uploaded:
// nothing here knows of the functions that plan maps and promise their errors.
#pragma once

#include "executor/executor.h"

namespace gnomon::proof {

/// The length over which a texel's differences are taken, of a pixel's width: far below any texel that matters, far
/// above what doubles lose.
constexpr double kStepOverPixel = 1e-3;

/// How far a texel reaches at a point, measured across the light: world units, without the receiver's slope.
struct TexelWidths {
    double x = 0; // along the light frame's x
    double z = 0; // along its z, without the shear
};

/// A whole texel at a point, as displacements across the light (draw space): sheared, as it is.
struct TexelFootprint {
    glm::dvec3 column{0}; // to the same place in the next column
    glm::dvec3 row{0};
};

/// One map of a frame as its texels are.
class TexelProbe {
public:
    TexelProbe(const executor::FrameDrawing& frame, const shadow::ShadowMap& map);

    /// The widths at `p` (draw space); `step` is the world length over which differences are taken, well under a texel.
    TexelWidths widths(const glm::dvec3& p, double step) const;

    TexelFootprint footprint(const glm::dvec3& p, double step) const;

private:
    struct Derivatives {
        glm::dvec2 byX{0}; // of (column, row)
        glm::dvec2 byZ{0};
    };

    glm::dvec2 texel(const glm::dvec3& p) const;
    Derivatives derivatives(const glm::dvec3& p, double step) const;

    shadow::FloatMapImage image_; // the floats that are uploaded
    glm::dvec3 x_;                // of the light frame, in draw space
    glm::dvec3 z_;
};

} // namespace gnomon::proof
