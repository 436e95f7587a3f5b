#include "core/limit_error.h"
#include "hierarchy/validation.h"
#include "tests/pipeline/built_model.h"

#include <gtest/gtest.h>

#include <set>

namespace gnomon::pipeline {
namespace {

using hierarchy::kNone;

std::uint64_t trianglesOfLevel(const BuiltModel& model, std::uint32_t level) {
    std::uint64_t count = 0;
    for (const hierarchy::Page& page : model.pages())
        if (page.level == level) count += page.triangles.size();
    return count;
}

std::uint64_t allDropped(const BuildReport& report) {
    std::uint64_t count = 0;
    for (const auto& [reason, triangles] : report.summary.dropped)
        count += triangles;
    return count;
}

TEST(Build, EverySourceTriangleIsStoredOrCounted) {
    read::CodeMesh mesh = read::bumpySheet(40);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.triangles.push_back({3, 3, 9});         // one vertex twice
    mesh.triangles.push_back({41, 0, 1});        // the first triangle again, turned
    mesh.triangles.push_back({1, 0, 41});        // and the other way round
    mesh.positions.push_back(mesh.positions[5]); // the same place under another number
    mesh.triangles.push_back({n, 5, 80});
    mesh.positions.push_back(mesh.positions[7] + glm::dvec3(1e-12, 0, 0));
    mesh.triangles.push_back({n + 1, 7, 90});
    mesh.positions.push_back((mesh.positions[0] + mesh.positions[1]) * 0.5);
    mesh.triangles.push_back({0, n + 2, 1}); // almost no area, yet three corners: stays
    const BuiltModel model(read::CodeMesh(mesh.positions, mesh.triangles));
    EXPECT_EQ(model.report().summary.sourceTriangles, 3206U);
    EXPECT_EQ(model.report().summary.dropped.at("degenerate"), 2U);
    EXPECT_EQ(model.report().summary.dropped.at("doubled"), 2U);
    EXPECT_EQ(model.report().summary.dropped.at("collapsed_by_grid"), 1U);
    EXPECT_EQ(trianglesOfLevel(model, 0) + allDropped(model.report()), 3206U);
}

TEST(Build, SameBytesForAnyNumberOfThreads) {
    std::set<std::string> hashes;
    for (const int threads : {1, 2, 3}) {
        BuildOptions options;
        options.threads = threads;
        hashes.insert(BuiltModel(read::bumpySheet(120), options).report().contentHash);
    }
    EXPECT_EQ(hashes.size(), 1U);
}

TEST(Build, ThousandsOfSmallPartsGetCoarse) {
    const BuiltModel model(read::strewnBoxes(5000));
    EXPECT_LE(model.report().summary.coarsestTriangles, 1000U);
    EXPECT_EQ(model.report().irreducibleTriangles, 0U);
}

TEST(Build, ErrorsRiseAndBoundsNestTowardsTheRoot) {
    const BuiltModel model(read::bumpySheet(100));
    std::size_t tested = 0;
    for (const hierarchy::Page& page : model.pages())
        for (const hierarchy::Group& group : page.groups) {
            EXPECT_TRUE(hierarchy::encloses(group.bounds, model.summary().grid.local(group.box)));
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
                const std::uint32_t index = page.clusters[c].refinement;
                EXPECT_EQ(index == kNone, page.level == 0);
                if (index == kNone) continue;
                const hierarchy::Refinement& refinement = page.refinements[index];
                EXPECT_LE(refinement.error, group.error);
                EXPECT_GE(refinement.error, model.summary().grid.snapError());
                EXPECT_TRUE(hierarchy::encloses(group.bounds, refinement.bounds));
                const hierarchy::Group& finer = model.pages()[refinement.group.page].groups[refinement.group.group];
                EXPECT_EQ(finer.error, refinement.error);
                ++tested;
            }
        }
    EXPECT_GT(tested, 100U);
}

TEST(Build, TooLittleMemoryIsRefusedWithTheFigureThatWouldDo) {
    BuildOptions options;
    options.memory = mebibytes(1);
    try {
        const BuiltModel model(read::bumpySheet(10), options);
        FAIL() << "built";
    } catch (const LimitError& error) {
        EXPECT_EQ(error.limit(), Limit::Memory);
        const std::string& min = error.parts().expected;
        EXPECT_TRUE(min.ends_with("M or more")) << min;
        options.memory = mebibytes(std::stoull(min));
        const BuiltModel model(read::bumpySheet(10), options);
        EXPECT_GT(model.report().fileBytes, 0U);
    }
}

TEST(Build, MoreStuckTrianglesThanAllowedAreRefused) {
    BuildOptions options;
    options.maxIrreduciblePercent = -1; // not even none
    try {
        const BuiltModel model(read::bumpySheet(10), options);
        FAIL() << "built";
    } catch (const LimitError& error) {
        EXPECT_EQ(error.limit(), Limit::IrreducibleTriangles);
        EXPECT_EQ(error.parts().expected, "at most -1.00%");
    }
}

TEST(Build, AModelOfNoTrianglesIsRefused) {
    try {
        const BuiltModel model(read::CodeMesh({glm::dvec3(0), glm::dvec3(1)}, {{0, 1, 1}}));
        FAIL() << "it was built";
    } catch (const Error& error) {
        const std::string expected = "no triangles are left: expected at least 1, found 1 without area, 0 smaller";
        EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace gnomon::pipeline
