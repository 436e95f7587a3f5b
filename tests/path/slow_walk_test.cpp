// Walks through a real building and through all storeys of a plant of a million triangles.
#include "path/walk.h"
#include "tests/path/walk_facts.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon::path {
namespace {

TEST(SlowWalk, AtLeastThirtyMetresInEachStoreyOfAPlantsBuildings) {
    const MadeModel plant(made("plant", 1'000'000));
    constexpr int kStoreys = 9; // the yard, and eight floors of the boiler house of which one is also a turbine hall's
    for (int storey = 0; storey < kStoreys; ++storey) {
        const CameraPath path = walk(plant.file(), {storey, {}});
        const WalkFacts facts = factsOf(plant, path, {}, storey == 0 ? 0 : 0.6); // bars of gratings are a metre apart
        EXPECT_GE(facts.length, 30) << "storey " << storey;
        EXPECT_GE(facts.clearance, 0.15) << "storey " << storey;
        EXPECT_EQ(facts.strayed, 0) << "storey " << storey;
        EXPECT_NEAR(facts.lowest, 6.0 * storey + 1.7, 0.4) << "storey " << storey;
        EXPECT_LE(path.duration(), 60.001) << "storey " << storey;
    }
}

TEST(SlowWalk, AtLeastThirtyMetresInAClinic) {
    const char* folder = std::getenv("GNOMON_MODELS");
    if (folder == nullptr) GTEST_SKIP() << "no real models: GNOMON_MODELS is not set";
    const std::string packed = std::string(folder) + "/bim_clinic.ply.xz";
    const MadeModel clinic([&](const std::string& path) {
        ASSERT_EQ(std::system(("xz -dc '" + packed + "' > '" + path + "'").c_str()), 0);
    });
    for (const std::optional<int>& storey : {std::optional<int>(), std::optional<int>(0), std::optional<int>(1)}) {
        const std::string name = storey ? "storey " + std::to_string(*storey) : "all of it";
        const WalkFacts facts = factsOf(clinic, walk(clinic.file(), {storey, {}}), {});
        EXPECT_GE(facts.length, 30) << name;
        EXPECT_GE(facts.clearance, 0.15) << name;
        EXPECT_EQ(facts.strayed, 0) << name;
        if (!storey) {
            EXPECT_GT(facts.highest - facts.lowest, 4) << "by the stairs";
        }
    }
}

} // namespace
} // namespace gnomon::path
