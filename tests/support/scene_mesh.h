// Scenes of quads and boxes as a hierarchy with one level, so that a test can place objects at known positions.
#pragma once

#include "tests/support/tiny_model.h"

namespace gnomon::tests {

/// A collection of pieces, each with its own cluster and root group. Positions must be within 2^20 units of `origin`
/// and are snapped to 2^-10 units.
class SceneMesh {
public:
    explicit SceneMesh(const glm::dvec3& origin = glm::dvec3(0)) : origin_(origin) {}

    /// Adds a parallelogram with a corner and two edge vectors, relative to the origin.
    void addQuad(const glm::dvec3& corner, const glm::dvec3& first, const glm::dvec3& second);

    /// Adds the six sides of a box.
    void addBox(const glm::dvec3& min, const glm::dvec3& max);

    /// Adds a level ground of `count` x `count` quads with total side length `size`, centred at the vertical axis
    /// through the origin.
    void addGround(double size, int count, double height = 0);

    TinyModel model() const;

private:
    struct Piece {
        std::vector<glm::dvec3> vertices;
        std::vector<hierarchy::Triangle> triangles;
    };

    glm::dvec3 origin_;
    std::vector<Piece> pieces_;
};

} // namespace gnomon::tests
