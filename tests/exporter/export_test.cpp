// Exported cuts are the cuts asked for, as meshes that the reader takes back.
#include "core/error.h"
#include "core/formatted.h"
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/exporter/export.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace gnomon::exporter {
namespace {

std::string pathFor(const std::string& name) {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    return testing::TempDir() + "gnomon_export_" + test + "_" + name;
}

/// All of a PLY.
struct Read {
    read::MeshSummary summary;
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> colors;
    std::vector<read::TriangleCorners> triangles;
};

Read readBack(const std::string& path) {
    Read read;
    const auto source = read::openMeshSources({path}, mebibytes(64));
    read.summary = source->summary();
    source->readVertices([&read](const read::VertexBlock& block) {
        read.positions.insert(read.positions.end(), block.positions.begin(), block.positions.end());
        read.normals.insert(read.normals.end(), block.normals.begin(), block.normals.end());
        read.colors.insert(read.colors.end(), block.colors.begin(), block.colors.end());
    });
    source->readTriangles([&read](const read::TriangleBlock& block) {
        read.triangles.insert(read.triangles.end(), block.triangles.begin(), block.triangles.end());
    });
    return read;
}

TEST(Export, TheFinestCutIsTheSource) {
    tests::TinyModelOptions options;
    options.normals = true;
    options.colors = true;
    const tests::TinyModel model = tests::makeTinyModel(options);
    tests::writeModel(model, pathFor("m.gnm"));
    NoProgress progress;
    const ExportedCut cut =
        exportCut(pathFor("m.gnm"), {{}, model.summary.grid.snapError()}, pathFor("out.ply"), progress);
    EXPECT_EQ(cut.triangles, 2048U);
    EXPECT_EQ(cut.vertices, 33U * 33U);
    EXPECT_EQ(cut.error, model.summary.grid.snapError());
    const Read read = readBack(pathFor("out.ply"));
    EXPECT_EQ(read.triangles.size(), 2048U);
    EXPECT_EQ(read.positions.size(), 33U * 33U);
    EXPECT_FALSE(read.summary.isDouble);
    ASSERT_EQ(read.normals.size(), read.positions.size());
    ASSERT_EQ(read.colors.size(), read.positions.size());
    Box box;
    for (const glm::dvec3& p : read.positions)
        box.add(p);
    EXPECT_EQ(box.min, model.summary.bounds.min);
    EXPECT_EQ(box.max, model.summary.bounds.max);
    for (const glm::vec3& n : read.normals) {
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
        EXPECT_GT(n.y, 0) << "a height field faces up";
    }
    double ground = 0;
    for (const auto& [a, b, c] : read.triangles) {
        const glm::dvec3 area =
            glm::cross(read.positions[b] - read.positions[a], read.positions[c] - read.positions[a]);
        EXPECT_GT(area.y, 0) << "the winding is the source's";
        ground += area.y / 2;
    }
    EXPECT_DOUBLE_EQ(ground, 32.0 * 32.0);
}

/// A model of 8192 triangles, written to m.gnm.
tests::TinyModel writtenModel() {
    tests::TinyModelOptions options;
    options.gridExponent = 6;
    tests::TinyModel model = tests::makeTinyModel(options);
    tests::writeModel(model, pathFor("m.gnm"));
    return model;
}

TEST(Export, KeepsTheCapOnTriangles) {
    const tests::TinyModel model = writtenModel();
    NoProgress progress;
    double error = 0;
    for (const std::uint64_t max : {100'000U, 8192U, 8191U, 5000U, 3000U, 2000U, 1000U}) {
        if (max < model.summary.coarsestTriangles) continue;
        const ExportedCut cut = exportCut(pathFor("m.gnm"), {max, {}}, pathFor("out.ply"), progress);
        EXPECT_LE(cut.triangles, max);
        EXPECT_GT(cut.triangles, std::min<std::uint64_t>(max, 8192) / 3) << "much coarser than asked for";
        EXPECT_GE(cut.error, error);
        error = cut.error;
        EXPECT_EQ(readBack(pathFor("out.ply")).triangles.size(), cut.triangles);
    }
    EXPECT_THROW(
        exportCut(pathFor("m.gnm"), {model.summary.coarsestTriangles - 1, {}}, pathFor("none.ply"), progress), Error);
    const double tooExact = model.summary.grid.snapError() / 2;
    EXPECT_THROW(exportCut(pathFor("m.gnm"), {{}, tooExact}, pathFor("none.ply"), progress), Error);
    EXPECT_FALSE(std::filesystem::exists(pathFor("none.ply")));
}

/// The area of a height field's triangles from above: that of its ground where nothing is missing or there twice.
double areaFromAbove(const Read& read) {
    double area = 0;
    for (const auto& [a, b, c] : read.triangles)
        area += glm::cross(read.positions[b] - read.positions[a], read.positions[c] - read.positions[a]).y / 2;
    return area;
}

// Of a plain all groups have one error: from one level to the next lies nothing for an error alone.
TEST(Export, ComesNearTheCapWhereManyGroupsHaveOneError) {
    for (const double height : {0.0, 3.0}) {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = height;
        const tests::TinyModel model = tests::makeTinyModel(options);
        tests::writeModel(model, pathFor("m.gnm"));
        NoProgress progress;
        Random random(5);
        double error = std::numeric_limits<double>::infinity();
        for (std::uint64_t max = model.summary.coarsestTriangles; max <= 8192; max += 200 + random.below(300)) {
            const ExportedCut cut = exportCut(pathFor("m.gnm"), {max, {}}, pathFor("out.ply"), progress);
            EXPECT_LE(cut.triangles, max);
            EXPECT_GE(cut.triangles + 600, max) << "a group has no more";
            EXPECT_LE(cut.error, error);
            error = cut.error;
            EXPECT_DOUBLE_EQ(areaFromAbove(readBack(pathFor("out.ply"))), 64.0 * 64.0) << max;
        }
    }
}

TEST(Export, KeepsTheCapOnTheError) {
    const tests::TinyModel model = writtenModel();
    NoProgress progress;
    std::uint64_t triangles = 8193;
    for (const hierarchy::LevelInfo& level : model.summary.levels) {
        const ExportedCut cut = exportCut(pathFor("m.gnm"), {{}, level.maxError}, pathFor("out.ply"), progress);
        EXPECT_LE(cut.error, level.maxError);
        EXPECT_LT(cut.triangles, triangles);
        triangles = cut.triangles;
    }
    EXPECT_EQ(triangles, model.summary.coarsestTriangles);
}

// All cuts of a flat model are as exact as its grid. Full detail is what an error of 0 asks for.
TEST(Export, AnErrorOf0IsFullDetailOfAFlatModelToo) {
    tests::TinyModel model = tests::makeTinyModel({});
    const double snapError = model.summary.grid.snapError();
    for (hierarchy::Page& page : model.pages) {
        for (hierarchy::Group& group : page.groups)
            group.error = std::min(group.error, std::isinf(group.error) ? group.error : snapError);
        for (hierarchy::Refinement& refinement : page.refinements)
            refinement.error = snapError;
    }
    tests::writeModel(model, pathFor("flat.gnm"));
    NoProgress progress;
    const auto triangles = [&](double error) {
        return exportCut(pathFor("flat.gnm"), {{}, error}, pathFor("out.ply"), progress).triangles;
    };
    EXPECT_EQ(triangles(0), model.summary.levels.front().triangles);
    EXPECT_EQ(triangles(snapError), model.summary.coarsestTriangles);
    try {
        triangles(snapError / 2);
        FAIL() << "finer than the grid";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(formatted("%g", snapError / 2)), std::string::npos) << error.what();
    }
}

TEST(Export, FarFromTheOriginPositionsAreDoubles) {
    tests::TinyModelOptions options;
    options.gridExponent = 3;
    options.origin = {1e7, 1e7, 1e7};
    const tests::TinyModel model = tests::makeTinyModel(options);
    tests::writeModel(model, pathFor("m.gnm"));
    NoProgress progress;
    exportCut(pathFor("m.gnm"), {1000, {}}, pathFor("out.ply"), progress);
    const Read read = readBack(pathFor("out.ply"));
    EXPECT_TRUE(read.summary.isDouble);
    Box box;
    for (const glm::dvec3& p : read.positions)
        box.add(p);
    EXPECT_EQ(box.min, model.summary.bounds.min);
    EXPECT_EQ(box.max, model.summary.bounds.max);
}

/// The same cut as a PLY, which keeps the source's axes, and as a .glb.
struct BothExports {
    Read ply, glb;
};

BothExports bothExports(const std::string& model, std::uint64_t max) {
    NoProgress progress;
    const ExportLimit limit{max, {}};
    const ExportedCut cut = exportCut(model, limit, pathFor("out.ply"), progress);
    const ExportedCut again = exportCut(model, limit, pathFor("out.glb"), progress, ExportFormat::Glb);
    EXPECT_EQ(cut.triangles, again.triangles);
    EXPECT_EQ(cut.vertices, again.vertices);
    return {readBack(pathFor("out.ply")), readBack(pathFor("out.glb"))};
}

TEST(Export, AGlbIsThePlyOfTheSameCut) {
    for (const bool hasColors : {false, true})
        for (const bool hasNormals : {false, true}) {
            tests::TinyModelOptions options;
            options.normals = hasNormals;
            options.colors = hasColors;
            tests::writeModel(tests::makeTinyModel(options), pathFor("m.gnm"));
            const auto [ply, glb] = bothExports(pathFor("m.gnm"), 1000);
            EXPECT_EQ(glb.triangles, ply.triangles);
            EXPECT_EQ(glb.positions, ply.positions);
            EXPECT_EQ(glb.colors, ply.colors);
            ASSERT_EQ(glb.normals.size(), ply.normals.size());
            for (std::size_t i = 0; i < glb.normals.size(); ++i)
                EXPECT_LT(glm::length(glb.normals[i] - ply.normals[i]), 1e-5F);
        }
}

TEST(Export, AGlbIsUprightInMetresAndNearItsOwnOrigin) {
    tests::TinyModelOptions options;
    options.origin = {500'000, 5'200'000, 400};
    tests::TinyModel model = tests::makeTinyModel(options);
    model.summary.up = {{0, 0, 1}};
    model.summary.unit = hierarchy::Unit::Foot;
    tests::writeModel(model, pathFor("m.gnm"));
    const auto [ply, glb] = bothExports(pathFor("m.gnm"), 1000);
    ASSERT_EQ(glb.positions.size(), ply.positions.size());
    Box box;
    for (const glm::dvec3& p : ply.positions)
        box.add(p);
    const double within = 0.3048 * glm::length(box.max - box.min) * 0x1p-24 + 5'200'000 * 0x1p-50;
    for (std::size_t i = 0; i < glb.positions.size(); ++i) {
        const glm::dvec3 p = ply.positions[i] * 0.3048;
        const glm::dvec3 expected(p.x, p.z, -p.y); // z goes up, what was north goes away from the viewer
        EXPECT_LT(glm::length(glb.positions[i] - expected), within) << i;
    }
    EXPECT_EQ(glb.triangles, ply.triangles);
}

TEST(Octahedral, UnpacksTheAxesAndTheFold) {
    using hierarchy::unpackNormal;
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-4; };
    EXPECT_TRUE(near(unpackNormal(0x00000000U), {0, 0, 1}));
    EXPECT_TRUE(near(unpackNormal(0x00007FFFU), {1, 0, 0}));
    EXPECT_TRUE(near(unpackNormal(0x7FFF0000U), {0, 1, 0}));
    EXPECT_TRUE(near(unpackNormal(0x00008001U), {-1, 0, 0}));
    EXPECT_TRUE(near(unpackNormal(0x7FFF7FFFU), {0, 0, -1}));
    EXPECT_TRUE(near(unpackNormal(0x40004000U), glm::normalize(glm::dvec3(1, 1, 0))));
}

TEST(Octahedral, PackedDirectionsComeBackWithinAFewTenthsOfADegree) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::length(v) < 1e-3) continue;
        const std::uint32_t packed = hierarchy::packNormal(v);
        ASSERT_NE(packed, hierarchy::kNoNormal);
        const glm::dvec3 back = hierarchy::unpackNormal(packed);
        EXPECT_LT(glm::length(glm::cross(glm::normalize(v), back)), 0.0045) << "0.26 degrees";
        EXPECT_GT(glm::dot(v, back), 0);
        EXPECT_EQ(packed & 0x003F003FU, 0U) << "low bits cost bytes";
    }
    EXPECT_EQ(hierarchy::packNormal({0, 0, 0}), hierarchy::kNoNormal);
    EXPECT_EQ(hierarchy::packNormal({0, std::nan(""), 1}), hierarchy::kNoNormal);
}

} // namespace
} // namespace gnomon::exporter
