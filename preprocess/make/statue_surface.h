// The surface of the statue as a fixed table of points and directions over (meridian, ring). The table is the same for
// each resolution.
#pragma once

#include "preprocess/make/bust_shape.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::make {

/// A point of the surface and the unit direction of its displacement.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 outward{0};
};

/// The carved surface without grain, C2 except at the two poles. The constructor takes about a second. Any thread can
/// read the surface.
class StatueSurface {
public:
    explicit StatueSurface(std::uint64_t seed);

    /// Returns the point at `along` in [0, 1] from the centre of the base to the crown, evenly spaced on average, and
    /// at `around` in [0, 4), one unit per quarter turn.
    SurfacePoint at(float along, float around) const;

    /// Return the end of the flat base and the start of the crown, as `along`.
    float baseEnd() const { return baseEnd_; }

    float crownBegin() const { return crownBegin_; }

    /// Return the area (square metres) and the meridian length (metres) of the surface of the table.
    double area() const { return area_; }

    double meridian() const { return meridian_; }

private:
    struct Texel {
        glm::vec4 position{0}; // w is unused, so that four floats load at once
        glm::vec4 outward{0};
    };

    void sampleMeridian(const BustShape& shape);
    void castRays(const BustShape& shape);
    void findOutward();
    void measure();
    const Texel& texel(std::size_t row, std::size_t column) const;

    std::vector<double> rayAlong_; // per row, the ray parameter in [0, 3]
    std::vector<Texel> texels_;
    float baseEnd_ = 0;
    float crownBegin_ = 1;
    double area_ = 0;
    double meridian_ = 0;
};

} // namespace gnomon::make
