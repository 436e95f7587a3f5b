// What is under the cursor, against rays that meet every triangle of the model.
#include "core/random.h"
#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "render/software_backend.h"
#include "tests/support/tiny_model.h"
#include "viewer/input/picking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace gnomon::viewer {
namespace {

/// How far along `direction` from `eye` a triangle lies (Moeller and Trumbore 1997); infinite where it is not met.
double distanceTo(const std::array<glm::dvec3, 3>& p, const glm::dvec3& eye, const glm::dvec3& direction) {
    const double never = std::numeric_limits<double>::infinity();
    const glm::dvec3 a = p[1] - p[0];
    const glm::dvec3 b = p[2] - p[0];
    const glm::dvec3 h = glm::cross(direction, b);
    const double determinant = glm::dot(a, h);
    if (std::abs(determinant) < 1e-12) return never;
    const glm::dvec3 s = eye - p[0];
    const double u = glm::dot(s, h) / determinant;
    const glm::dvec3 q = glm::cross(s, a);
    const double v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(b, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : never;
}

/// The nearest point in which the ray from `eye` along `direction` meets a triangle of the finest level.
std::optional<glm::dvec3> firstHit(const tests::TinyModel& model, const glm::dvec3& eye, const glm::dvec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const hierarchy::Page& page : model.pages) {
        if (page.level != 0) continue;
        for (const hierarchy::Cluster& cluster : page.clusters)
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
                const hierarchy::Triangle& triangle = page.triangles[cluster.firstTriangle + t];
                const auto corner = [&](std::size_t i) {
                    return model.summary.grid.world(page.vertices[cluster.firstVertex + triangle[i]].position);
                };
                nearest = std::min(nearest, distanceTo({corner(0), corner(1), corner(2)}, eye, direction));
            }
    }
    if (std::isinf(nearest)) return std::nullopt;
    return eye + direction * nearest;
}

plan::View viewAround(const glm::dvec3& center, double angle, Projection projection) {
    plan::View view;
    view.width = 160;
    view.height = 120;
    view.camera = {
        center + 30.0 * glm::dvec3(std::cos(angle), 0.6, std::sin(angle)), center, {0, 1, 0}, 0.9, projection};
    return view;
}

bool isNear(const std::optional<glm::dvec3>& a, const std::optional<glm::dvec3>& b, double distance) {
    if (!a || !b) return a.has_value() == b.has_value();
    return glm::length(*a - *b) < distance;
}

TEST(Picking, FindsThePointThatARayThroughThePixelMeets) {
    tests::TinyModelOptions made;
    made.height = 6;
    made.origin = {1e5, -40, 7e4};
    const tests::TinyModel tiny = tests::makeTinyModel(made);
    const std::string path = testing::TempDir() + "gnomon_picking.gnm";
    tests::writeModel(tiny, path);
    const hierarchy::ModelFile model(path);
    const auto backend = render::makeSoftwareBackend();
    frame::Renderer renderer(model, *backend, {});
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Off;
    quality.errorPixels = 1e-6; // the finest level
    Random random(5);
    const Box& bounds = model.summary().bounds;
    for (int i = 0; i < 12; ++i) {
        const bool isParallel = i >= 6;
        const plan::View view = viewAround(
            bounds.center(), random.uniform(0, 6.28), isParallel ? Projection::Orthographic : Projection::Perspective);
        renderer.render(view, quality, {});
        const render::FloatPicture depth = backend->viewDepth();
        const CameraBasis basis = cameraBasis(view.camera);
        // The rasteriser snaps corners to 1/256 pixel, which on grazing triangles moves depths along.
        constexpr double kAllowance = 0.02; // of edges one unit long
        int unlike = 0;
        int hits = 0;
        for (int y = 3; y < 120; y += 7)
            for (int x = 3; x < 160; x += 7) {
                const double tangent = view.tanHalfY() / 60;
                const glm::dvec3 at((x + 0.5 - 80) * tangent, (60 - y - 0.5) * tangent, 0);
                const glm::dvec3 aside = toWorld(basis, at * glm::length(view.camera.target - view.camera.eye));
                const auto expected =
                    isParallel ? firstHit(tiny, view.camera.eye + aside, basis.view)
                               : firstHit(tiny, view.camera.eye, glm::normalize(basis.view + toWorld(basis, at)));
                const auto found = pointUnder(depth, view.camera, {x, y}, 0);
                hits += expected ? 1 : 0;
                unlike += isNear(expected, found, kAllowance) ? 0 : 1;
            }
        EXPECT_GT(hits, 50);
        EXPECT_LE(unlike, 2); // on silhouettes, where one is as right as the other
    }
    std::filesystem::remove(path);
}

TEST(Picking, ReachesForTheNearestDrawnPixel) {
    render::FloatPicture depth(20, 20, std::numeric_limits<float>::infinity());
    depth.at(12, 10) = 3;
    depth.at(10, 15) = 4;
    const Camera camera;
    EXPECT_FALSE(pointUnder(depth, camera, {10, 10}, 1));
    EXPECT_NEAR(pointUnder(depth, camera, {10, 10}, 6)->z, -3, 1e-6);
    EXPECT_NEAR(pointUnder(depth, camera, {10, 14}, 6)->z, -4, 1e-6);
    EXPECT_FALSE(pointUnder(depth, camera, {-50, -50}, 6));
}

} // namespace
} // namespace gnomon::viewer
