#include "core/camera.h"
#include "core/error.h"
#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon {
namespace {

TEST(Camera, BasisIsOrthonormalAndLeftHanded) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        Camera camera;
        camera.eye = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        camera.target = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const CameraBasis basis = cameraBasis(camera);
        EXPECT_NEAR(glm::length(glm::cross(basis.right, basis.up) + basis.view), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(basis.up), 1.0, 1e-12);
        const glm::dvec3 target = toCamera(basis, camera.target - camera.eye);
        EXPECT_NEAR(target.x, 0.0, 1e-12);
        EXPECT_NEAR(target.y, 0.0, 1e-12);
        EXPECT_GT(target.z, 0.0);
        EXPECT_NEAR(glm::length(toWorld(basis, target) - (camera.target - camera.eye)), 0.0, 1e-12);
    }
}

TEST(Camera, LookingAlongUpStillHasABasis) {
    Camera camera;
    camera.target = {0, -5, 0};
    const CameraBasis basis = cameraBasis(camera);
    EXPECT_NEAR(glm::length(basis.right), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(basis.up, basis.view), 0.0, 1e-12);
}

// The axis furthest from the view takes the place of an up that says nothing; equal ones in the order x, y, z.
TEST(Camera, LookingAlongUpTakesTheFurthestAxisForUp) {
    const auto upOf = [](const glm::dvec3& view) { return cameraBasis({glm::dvec3(0), view, view, 1}).up; };
    EXPECT_EQ(upOf({0, 0, -1}), glm::dvec3(1, 0, 0));
    EXPECT_EQ(upOf({0, -1, 0}), glm::dvec3(1, 0, 0));
    EXPECT_EQ(upOf({1, 0, 0}), glm::dvec3(0, 1, 0));
    EXPECT_NEAR(glm::dot(upOf({3, 2, 1}), glm::dvec3(0, 0, 1)), std::sqrt(13.0 / 14), 1e-12);
    EXPECT_NEAR(glm::dot(upOf({2, 1, 3}), glm::dvec3(0, 1, 0)), std::sqrt(13.0 / 14), 1e-12);
}

TEST(Camera, AnUpOfAnyLengthGivesTheSameBasis) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const auto point = [&] {
            return glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        };
        const Camera camera{point(), point(), point(), 1};
        Camera scaled = camera;
        scaled.up *= std::exp(random.uniform(-20, 20));
        EXPECT_NEAR(glm::distance(cameraBasis(camera).right, cameraBasis(scaled).right), 0, 1e-9);
    }
}

TEST(Camera, NonsenseIsRefused) {
    Camera camera;
    camera.target = camera.eye;
    EXPECT_THROW(cameraBasis(camera), Error);
    camera.target = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    EXPECT_THROW(cameraBasis(camera), Error);
    for (int field = 0; field < 3; ++field)
        for (int axis = 0; axis < 3; ++axis) {
            Camera infinite;
            (field == 0   ? infinite.eye
             : field == 1 ? infinite.target
                          : infinite.up)[axis] = std::numeric_limits<double>::infinity();
            EXPECT_THROW(cameraBasis(infinite), Error) << field << axis;
        }
}

} // namespace
} // namespace gnomon
