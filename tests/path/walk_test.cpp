// Walks: on a floor, clear of everything, through rooms and over stairs; and what is said where there is no floor.
#include "core/error.h"
#include "lod/error_rule.h"
#include "lod/triangle_clip.h"
#include "path/walk.h"
#include "tests/path/building.h"
#include "tests/path/turbine_hall.h"
#include "tests/path/walk_facts.h"

#include <gtest/gtest.h>

namespace gnomon::path {
namespace {

constexpr double kClear = 0.15; // metres

/// What `walk` says instead of a path.
std::string refusal(const MadeModel& model, const WalkOptions& options) {
    try {
        walk(model.file(), options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

void expectOnFloorAndClear(const WalkFacts& facts, const std::string& name) {
    EXPECT_GE(facts.clearance, kClear) << name;
    EXPECT_EQ(facts.strayed, 0) << name;
}

/// The least distance that is free ahead of the eye, but for the last strides; and the largest turn in a second.
std::pair<double, double> outlook(const MadeModel& model, const CameraPath& path) {
    std::pair<double, double> worst(std::numeric_limits<double>::infinity(), 0);
    const auto gazeAt = [&](double time) {
        const Camera camera = cameraAt(path, time);
        return glm::normalize(camera.target - camera.eye);
    };
    for (double time = 0; time + 2 < path.duration(); time += 0.25) {
        const std::vector<double> met = model.met(cameraAt(path, time).eye, gazeAt(time));
        if (!met.empty()) worst.first = std::min(worst.first, met.front());
        const double cosine = glm::dot(gazeAt(time), gazeAt(time + 1));
        worst.second = std::max(worst.second, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    return worst;
}

TEST(Walk, LeadsThroughTheDoorsOfSeededBuildingsAndThroughNoWall) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const std::string name = "seed " + std::to_string(seed);
        const Building building(seed, 4, 2 + static_cast<int>(seed % 3));
        const MadeModel model(building);
        const CameraPath path = walk(model.file(), {});
        expectOnFloorAndClear(factsOf(model, path, {}), name);
        std::set<int> rooms;
        int last = building.roomAt(path.keyframes.front().camera.eye);
        for (const Keyframe& key : path.keyframes) {
            const int room = building.roomAt(key.camera.eye);
            EXPECT_TRUE(room == last || building.areJoined(room, last)) << name << ": " << last << " to " << room;
            rooms.insert(room);
            last = room;
        }
        EXPECT_GE(static_cast<int>(rooms.size()), building.longestWay() - 2) << name;
        EXPECT_EQ(toJson(path), toJson(walk(model.file(), {}))) << name;
        const auto [ahead, turn] = outlook(model, path);
        EXPECT_GT(ahead, 0.8) << name << ": a wall in the face";
        EXPECT_LT(turn, 1.5) << name << ": radians";
    }
}

/// Two high storeys with a flight of stairs from one to the other, in a house of 13 m by 4 m.
struct Stairs {
    static constexpr double kStorey = 4.4;

    bool hasUpperFloor = true;

    void operator()(const std::string& path) const {
        constexpr int kSteps = 24;
        Boxes boxes;
        boxes.add({0, -0.2, 0}, {13, 0, 4});
        boxes.add({0, 2 * kStorey, 0}, {13, 2 * kStorey + 0.2, 4});
        for (const double x : {-0.2, 13.0})
            boxes.add({x, -0.2, 0}, {x + 0.2, 2 * kStorey, 4});
        for (const double z : {-0.2, 4.0})
            boxes.add({-0.2, -0.2, z}, {13.2, 2 * kStorey, z + 0.2});
        if (!hasUpperFloor) return boxes.write(path);
        boxes.add({8, kStorey - 0.2, 0}, {13, kStorey, 4});
        for (int step = 1; step < kSteps; ++step) {
            const double x = 8 - 0.26 * (kSteps - step);
            boxes.add({x, 0, 2.6}, {x + 0.26, kStorey * step / kSteps, 4});
        }
        boxes.write(path);
    }
};

TEST(Walk, ClimbsStairsOrStaysInTheStoreyThatIsAskedFor) {
    const MadeModel model(Stairs{});
    const WalkFacts both = factsOf(model, walk(model.file(), {}), {});
    expectOnFloorAndClear(both, "both");
    EXPECT_NEAR(both.lowest, 1.7, 0.1);
    EXPECT_NEAR(both.highest, Stairs::kStorey + 1.7, 0.1);
    const WalkFacts lower = factsOf(model, walk(model.file(), {0, {}}), {});
    expectOnFloorAndClear(lower, "lower");
    EXPECT_LT(lower.highest, 1.7 + 1);
    const WalkFacts upper = factsOf(model, walk(model.file(), {1, {}}), {});
    expectOnFloorAndClear(upper, "upper");
    EXPECT_GT(upper.lowest, Stairs::kStorey + 0.9);
}

TEST(Walk, AtLeastThirtyMetresInBothStoreysOfATurbineHall) {
    for (const int quarterTurns : {0, 1}) {
        const MadeModel model(TurbineHall(0.9, quarterTurns));
        for (const int storey : {0, 1}) {
            const CameraPath path = walk(model.file(), {storey, {}});
            const WalkFacts facts = factsOf(model, path, {}, storey == 0 ? 0 : 0.6); // bars are a metre apart
            expectOnFloorAndClear(facts, "storey " + std::to_string(storey));
            EXPECT_GE(facts.length, 30);
            EXPECT_NEAR(facts.lowest, 6 * storey + 1.7, 0.4);
        }
    }
}

TEST(Walk, SaysWhichStoreysThereAre) {
    const MadeModel model(Stairs{});
    const std::string said = refusal(model, {2, {}});
    EXPECT_NE(said.find("unknown storey: expected 0 (at -0.0"), std::string::npos) << said;
    EXPECT_NE(said.find("), 1 (at 4.3"), std::string::npos) << said << ": none between, on the stairs";
    EXPECT_EQ(said.find(", 2 (at"), std::string::npos) << said;
    const MadeModel hall(Stairs{false});
    EXPECT_NE(refusal(hall, {1, {}}).find("), found 1"), std::string::npos) << "an upper level without floor";
    EXPECT_EQ(refusal(hall, {1, {}}).find("1 (at"), std::string::npos) << "an upper level without floor";
}

TEST(Walk, WallsWithoutAFloorAreRefused) {
    const MadeModel model([](const std::string& path) {
        Boxes boxes;
        for (int i = 0; i <= 10; ++i) {
            boxes.add({3.0 * i, 0, 0}, {3.0 * i + 0.2, 3, 30});
            boxes.add({0, 0, 3.0 * i}, {30, 3, 3.0 * i + 0.2});
        }
        boxes.write(path);
    });
    const std::string said = refusal(model, {});
    EXPECT_NE(said.find("no floor to walk on: expected a level place"), std::string::npos) << said;
    EXPECT_NE(said.find("found none in a model of 30.2 x 3 x 30.2"), std::string::npos) << said;
}

TEST(Walk, GoesAroundAThingThatHasNoFloor) {
    const MadeModel statue(made("statue", 20000));
    const Box& bounds = statue.file().summary().bounds;
    const CameraPath path = walk(statue.file(), {});
    const double eyeHeight = path.keyframes.front().camera.eye.y - bounds.min.y;
    EXPECT_GT(eyeHeight, 0.1 * bounds.extent().y);
    EXPECT_LT(eyeHeight, 0.5 * bounds.extent().y);
    for (const Keyframe& key : path.keyframes) {
        EXPECT_DOUBLE_EQ(key.camera.eye.y, path.keyframes.front().camera.eye.y);
        EXPECT_GT(statue.clearance(key.camera.eye, eyeHeight), 0.2 * eyeHeight);
    }
    EXPECT_NE(refusal(statue, {0, {}}).find("no floor to walk on"), std::string::npos) << "nor has it a storey";
    EXPECT_NE(refusal(statue, {9, 1.7}).find("no floor to walk on"), std::string::npos) << "whichever is asked for";
}

TEST(Walk, TakesTheScaleFromTheEye) {
    const MadeModel model([](const std::string& path) { // the house in millimetres
        Stairs{}(path + ".metres");
        std::ifstream metres(path + ".metres");
        std::ofstream file(path);
        std::string line;
        for (bool isHeader = true; std::getline(metres, line);) {
            double x = 0;
            double y = 0;
            double z = 0;
            const bool isVertex = !isHeader && std::sscanf(line.c_str(), "%lf %lf %lf %*f", &x, &y, &z) == 3 &&
                                  std::count(line.begin(), line.end(), ' ') == 2;
            isHeader = isHeader && line != "end_header";
            if (isVertex)
                file << 1000 * x << ' ' << 1000 * y << ' ' << 1000 * z << '\n';
            else
                file << line << '\n';
        }
        std::filesystem::remove(path + ".metres");
    });
    const WalkBody body = WalkBody::ofEyeHeight(1700);
    const WalkFacts facts = factsOf(model, walk(model.file(), {{}, 1700}), body);
    EXPECT_GE(facts.clearance, 1000 * kClear);
    EXPECT_EQ(facts.strayed, 0);
    EXPECT_NEAR(facts.highest, 1000 * Stairs::kStorey + 1700, 100);
}

/// The least and the largest view depth of anything within the view of `camera`, whose image is square.
std::pair<double, double> depths(const MadeModel& model, const Camera& camera) {
    lod::DetailView view;
    view.eye = camera.eye;
    view.basis = cameraBasis(camera);
    view.tanHalfX = view.tanHalfY = std::tan(camera.fovYRadians / 2);
    const ConvexVolume pyramid = lod::viewPyramid(view);
    lod::TriangleClipper clipper(pyramid);
    std::pair<double, double> result(std::numeric_limits<double>::infinity(), 0);
    for (const std::array<glm::dvec3, 3>& triangle : model.triangles())
        for (const glm::dvec3& point : clipper.clipped(triangle)) {
            const double depth = glm::dot(view.basis.view, point - view.eye);
            result = {std::min(result.first, depth), std::max(result.second, depth)};
        }
    return result;
}

TEST(Walk, PassesThePipesOfAPlantAndSeesNearAndFar) {
    const MadeModel plant(made("plant", 60000));
    const CameraPath path = walk(plant.file(), {});
    const WalkFacts facts = factsOf(plant, path, {});
    expectOnFloorAndClear(facts, "plant");
    EXPECT_GT(facts.length, 30);
    EXPECT_LE(path.duration(), 60.001);
    for (const double share : {0.0, 0.5, 1.0}) {
        const auto [min, max] = depths(plant, cameraAt(path, share * path.duration()));
        EXPECT_GT(max / min, 30) << "a high depth range at " << share;
    }
}

} // namespace
} // namespace gnomon::path
