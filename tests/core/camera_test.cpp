#include "core/camera.h"
#include "core/error.h"
#include "core/random.h"

#include <gtest/gtest.h>

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

TEST(Camera, NonsenseIsRefused) {
    Camera camera;
    camera.target = camera.eye;
    EXPECT_THROW(cameraBasis(camera), Error);
    camera.target = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    EXPECT_THROW(cameraBasis(camera), Error);
}

} // namespace
} // namespace gnomon
