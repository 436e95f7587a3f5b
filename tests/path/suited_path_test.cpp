// The paths that `gnomon path` finds, but for walks: where they lead.
#include "hierarchy/upright_frame.h"
#include "path/suited_path.h"
#include "tests/path/boxes.h"
#include "tests/path/made_model.h"
#include "tests/support/temporary_model.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::path {
namespace {

constexpr int kSamples = 400; // along a path

double timeAt(const CameraPath& path, int sample) {
    return path.keyframes.front().time + path.duration() * sample / (kSamples - 1);
}

TEST(SuitedPath, AnApproachComesFromFarToVeryNear) {
    const MadeModel statue(made("statue", 20000));
    const Box& bounds = statue.file().summary().bounds;
    const double size = glm::length(bounds.extent());
    const CameraPath path = suitedPath(statue.file(), "approach");
    const glm::dvec3 end = cameraAt(path, timeAt(path, kSamples - 1)).eye;
    double before = std::numeric_limits<double>::infinity();
    for (int sample = 0; sample < kSamples - 1; sample += 8) {
        const glm::dvec3 eye = cameraAt(path, timeAt(path, sample)).eye;
        EXPECT_LT(glm::distance(eye, end), before) << "always nearer, at sample " << sample;
        EXPECT_GT(statue.clearance(eye, 0.1 * size), 1e-4 * size) << "never through the surface, at sample " << sample;
        before = glm::distance(eye, end);
    }
    EXPECT_GT(statue.clearance(cameraAt(path, timeAt(path, 0)).eye, 4 * size), 1.5 * size);
    EXPECT_LT(statue.clearance(end, size), 0.005 * size);
}

/// Many small boxes in a flat grid, with gaps between them as wide as they are; far away on two sides one more each, so
/// that the grid is fine for the size of the model and coarse levels close its gaps.
struct Grating {
    int side = 60;          // boxes
    bool hasFloor = true;   // below, as wide as the grid
    double emptyRadius = 0; // where no boxes are, around the middle
    double reach = 100'000; // of the boxes far away

    void operator()(const std::string& path) const {
        Boxes boxes;
        for (int x = 0; x < side; ++x)
            for (int z = 0; z < side; ++z) {
                const glm::dvec3 middle(2 * x + 1.3 - side, 0, 2 * z + 1 - side);
                if (glm::length(middle) >= emptyRadius) boxes.add(middle - 0.5, middle + 0.5);
            }
        if (hasFloor) boxes.add({-side, -9, -side}, {side, -8, side});
        boxes.add({-reach, -1, -1}, {1 - reach, 0, 0});
        boxes.add({reach - 1, 0, 0}, {reach, 1, 1});
        boxes.write(path);
    }
};

/// An approach to `model` leads straight to a surface of its full detail, with nothing before it.
void expectApproachEndsBeforeASurface(const MadeModel& model, const char* name) {
    const CameraPath path = suitedPath(model.file(), "approach");
    const glm::dvec3 start = path.keyframes.front().camera.eye;
    for (const Keyframe& key : path.keyframes) {
        const glm::dvec3 way = key.camera.target - key.camera.eye;
        const std::vector<double> met = model.met(key.camera.eye, glm::normalize(way));
        ASSERT_FALSE(met.empty()) << name << ", at " << key.time << " s";
        EXPECT_NEAR(met.front(), glm::length(way), 1e-9 * glm::distance(start, key.camera.target))
            << name << ", at " << key.time << " s";
    }
}

TEST(SuitedPath, AnApproachEndsBeforeASurfaceOfFullDetail) {
    expectApproachEndsBeforeASurface(MadeModel(made("statue", 20000)), "statue");
    expectApproachEndsBeforeASurface(MadeModel(made("plant", 60000)), "plant");
    expectApproachEndsBeforeASurface(MadeModel(made("planes", 20000)), "planes");
    for (int side = 40; side < 44; ++side) // the line meets a box or goes between two
        expectApproachEndsBeforeASurface(MadeModel(Grating{side, true, 0}), "grating");
}

TEST(SuitedPath, AnApproachFindsWhatThereIsAroundAnEmptyMiddle) {
    for (const double emptyRadius : {0.0, 10.0, 40.0})
        expectApproachEndsBeforeASurface(MadeModel(Grating{40, false, emptyRadius}), "grating without a floor");
}

TEST(SuitedPath, OrbitAndFlybyStayOutsideAndLookAtTheModel) {
    const tests::TemporaryModel field({}, "field");
    const hierarchy::ModelFile file(field.path());
    const Box& bounds = file.summary().bounds;
    for (const char* kind : {"orbit", "flyby"}) {
        const CameraPath path = suitedPath(file, kind);
        for (int sample = 0; sample < kSamples; ++sample) {
            const Camera camera = cameraAt(path, timeAt(path, sample));
            EXPECT_GT(distance(bounds, camera.eye), 0) << kind;
            const glm::dvec3 towards = glm::normalize(camera.target - camera.eye);
            const glm::dvec3 middle = bounds.center() - camera.eye;
            if (path.loop) {
                EXPECT_GT(glm::dot(towards, glm::normalize(middle)), 0.99) << kind;
            }
        }
    }
}

/// A room with a wall in it, in metres and y up; in millimetres and z up.
void writeRoom(const std::string& path, bool isTurned) {
    Boxes boxes;
    boxes.add({0, -0.3, 0}, {12, 0, 9});
    boxes.add({0, 2.7, 0}, {12, 3, 9});
    boxes.add({-0.3, -0.3, 0}, {0, 3, 9});
    boxes.add({12, -0.3, 0}, {12.3, 3, 9});
    boxes.add({0, -0.3, -0.3}, {12, 3, 0});
    boxes.add({0, -0.3, 9}, {12, 3, 9.3});
    boxes.add({5, 0, 2}, {5.3, 2.7, 9});
    if (isTurned)
        for (glm::dvec3& corner : boxes.corners)
            corner = 1000.0 * hierarchy::uprightFrame({0, 0, 1}).toWorld(corner);
    boxes.write(path);
}

TEST(SuitedPath, FollowsWhatIsUpAndTheUnit) {
    const MadeModel plain([](const std::string& path) { writeRoom(path, false); });
    pipeline::BuildOptions options;
    options.up = hierarchy::upAxisNamed("z");
    options.unit = hierarchy::Unit::Millimetre;
    const MadeModel turned([](const std::string& path) { writeRoom(path, true); }, options);
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame({0, 0, 1});
    for (const char* kind : {"walk", "orbit", "flyby", "approach"}) {
        const CameraPath expected = suitedPath(plain.file(), kind);
        const CameraPath found = suitedPath(turned.file(), kind);
        EXPECT_NEAR(found.duration(), expected.duration(), 0.1 * expected.duration()) << kind;
        for (int sample = 0; sample < kSamples; sample += 20) {
            const Camera is = cameraAt(found, timeAt(found, sample));
            const Camera be = cameraAt(expected, timeAt(expected, sample));
            EXPECT_EQ(is.up, glm::dvec3(0, 0, 1)) << kind;
            EXPECT_LT(glm::distance(frame.toUpright(is.eye) / 1000.0, be.eye), 0.5) << kind << " at " << sample;
            EXPECT_NEAR(frame.toUpright(is.eye).y / 1000, be.eye.y, 0.1) << kind << " at " << sample;
        }
    }
}

TEST(SuitedPath, ThroughCamerasHasOneASecond) {
    const std::vector<Camera> cameras = {{{1, 0, 0}, {0, 0, 0}}, {{2, 0, 0}, {0, 0, 0}}, {{3, 0, 0}, {0, 0, 0}}};
    const CameraPath path = pathThrough(cameras);
    EXPECT_FALSE(path.loop);
    ASSERT_EQ(path.keyframes.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(path.keyframes[i].time, static_cast<double>(i));
        EXPECT_EQ(path.keyframes[i].camera.eye, cameras[i].eye);
    }
}

} // namespace
} // namespace gnomon::path
