// The surface of the statue as a table of points and outward directions. The table is indexed by (meridian, ring) and
// does not depend on the number of triangles.
#pragma once

#include "preprocess/make/bust_shape.h"

#include <array>
#include <span>
#include <vector>

namespace gnomon::make {

/// A point of the statue's surface, and the unit direction in which the stone's grain displaces it.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 outward{0};
};

/// The carved surface of the statue without the stone's grain. It is twice continuously differentiable except at the
/// two poles. The constructor takes about a second. All threads can read the surface at the same time.
class StatueSurface {
public:
    explicit StatueSurface(std::uint64_t seed);

    /// Returns a point of the statue's surface. `along` is in [0, 1], from the centre of the base to the crown, with
    /// even spacing on average. `around` is in [0, 4), with one unit per quarter turn.
    SurfacePoint at(float along, float around) const;

    /// These functions return the values of `along` at the end of the flat base and at the start of the crown.
    float baseEnd() const { return baseEnd_; }

    float crownBegin() const { return crownBegin_; }

    /// These functions return the area in square metres and the length of a meridian in metres, both computed from the
    /// table.
    double area() const { return area_; }

    double meridian() const { return meridian_; }

private:
    struct Texel {
        glm::vec4 position{0}; // w is unused; with four floats, one instruction loads the position
        glm::vec4 outward{0};
    };

    void sampleMeridian(const BustShape& shape);
    void castRays(const BustShape& shape);
    void findOutward();
    void measure();
    const Texel& texel(std::size_t row, std::size_t column) const;

    std::vector<double> rayAlong_; // ray parameter in [0, 3] per row (see rayAt)
    std::vector<Texel> texels_;
    float baseEnd_ = 0;
    float crownBegin_ = 1;
    double area_ = 0;
    double meridian_ = 0;
};

} // namespace gnomon::make
