// The statue's surface as a fixed table of points and directions over (meridian, ring), the same for every resolution.
#pragma once

#include "preprocess/make/bust_shape.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::make {

/// A point of the surface and the unit direction in which its stone is displaced.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 outward{0};
};

/// The carved surface before its grain: C2 but at the two poles. Built once (about a second), read from any thread.
class StatueSurface {
public:
    explicit StatueSurface(std::uint64_t seed);

    /// The point at `along` in [0, 1] from the middle of the base to the crown, evenly spaced on average, and `around`
    /// in [0, 4), one unit a quarter turn.
    SurfacePoint at(float along, float around) const;

    /// Where the base's flat part ends and where the crown begins, as `along`.
    float baseEnd() const { return baseEnd_; }

    float crownBegin() const { return crownBegin_; }

    /// Area and meridian length of the table's own surface, in square metres and metres.
    double area() const { return area_; }

    double meridian() const { return meridian_; }

private:
    struct Texel {
        glm::vec4 position{0}; // w is unused: four floats load at once
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
