// Scenes of quads and boxes as a hierarchy of one level, so that a test can say in words what stands where.
#pragma once

#include "hierarchy/tiny_model.h"

namespace gnomon::tests {

/// Collects pieces, each a cluster and a root group of its own; positions must lie within 2^20 units of `origin` and
/// are snapped to 2^-10 units.
class SceneMesh {
public:
    explicit SceneMesh(const glm::dvec3& origin = glm::dvec3(0)) : origin_(origin) {}

    /// A parallelogram from `corner`; origin's coordinates.
    void addQuad(const glm::dvec3& corner, const glm::dvec3& first, const glm::dvec3& second);

    /// The six sides of a box.
    void addBox(const glm::dvec3& min, const glm::dvec3& max);

    /// A level ground of `count` x `count` quads, `size` to a side, around the vertical axis through the origin.
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
