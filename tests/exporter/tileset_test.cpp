// 3D Tiles of a model: levels against a plain count, tiles that share each cut without rest, and a document whose boxes
// and errors nest.
#include "core/error.h"
#include "core/file.h"
#include "core/heap.h"
#include "hierarchy/cut_rule.h"
#include "preprocess/exporter/export.h"
#include "preprocess/exporter/tiles/tile_levels.h"
#include "preprocess/exporter/tiles/tile_mesh.h"
#include "preprocess/exporter/tiles/tileset.h"
#include "preprocess/read/open_mesh_sources.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::exporter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Tiles : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(place); }

    void TearDown() override { fs::remove_all(place); }

    std::string written(unsigned exponent, const std::function<void(tests::TinyModel&)>& change = {}) {
        tests::TinyModelOptions options;
        options.gridExponent = exponent;
        options.normals = true;
        options.colors = true;
        tests::TinyModel model = tests::makeTinyModel(options);
        if (change) change(model);
        tests::writeModel(model, place + "/m.gnm");
        return place + "/m.gnm";
    }

    const std::string place = testing::TempDir() + "gnomon_tiles_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name() +
                              std::to_string(::getpid());
    NoProgress progress;
};

double surfaceOf(const CutMesh& mesh, const hierarchy::Grid& grid) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](std::uint32_t v) { return grid.world(mesh.vertices[v].position); };
        area += glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / 2;
    }
    return area;
}

/// The triangles of the uniform cut at `limit`, page by page.
std::uint64_t plainCount(const hierarchy::ModelFile& file, double limit) {
    std::uint64_t triangles = 0;
    for (std::uint32_t p = 0; p < file.pages().size(); ++p)
        hierarchy::forEachDrawn(
            file.readPage(p),
            [&](double error, const Sphere&) { return error > limit; },
            [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) { triangles += cluster.triangleCount; });
    return triangles;
}

TEST_F(Tiles, LevelsAreCutsOfFourTimesTheTriangles) {
    const hierarchy::ModelFile file(written(6));
    const std::vector<TileCluster> clusters = clustersOf(file, progress);
    for (const std::uint64_t max : {100U, 500U, 3000U, 100'000U}) {
        const std::vector<double> limits = limitsOf(clusters, max);
        EXPECT_EQ(limits.back(), 0);
        auto allowed = static_cast<double>(max);
        for (std::size_t i = 0; i < limits.size(); ++i, allowed *= 4) {
            EXPECT_TRUE(i == 0 || limits[i] < limits[i - 1]);
            std::uint64_t triangles = 0;
            for (const TileCluster& cluster : clusters)
                if (cluster.isInCut(limits[i])) triangles += cluster.triangles;
            EXPECT_EQ(triangles, plainCount(file, limits[i]));
            const bool isBounded = i + 1 < limits.size() && max >= file.summary().coarsestTriangles;
            EXPECT_TRUE(!isBounded || static_cast<double>(triangles) <= allowed);
        }
    }
    EXPECT_EQ(limitsOf(clusters, 1'000'000), std::vector<double>{0}) << "one level is enough";
}

TEST_F(Tiles, CellsShareEachCutWithoutRest) {
    const hierarchy::ModelFile file(written(5));
    const std::vector<TileCluster> clusters = clustersOf(file, progress);
    const hierarchy::ModelSummary& summary = file.summary();
    PageCache pages(file, {1}); // of one page
    std::uint64_t extent = 0;
    for (const TileCluster& cluster : clusters)
        extent = std::max<std::uint64_t>({extent, cluster.box.max.x, cluster.box.max.y, cluster.box.max.z});
    const std::uint64_t side = std::bit_ceil(extent + 1);
    for (const double limit : limitsOf(clusters, 200)) {
        std::vector<const TileCluster*> cut;
        for (const TileCluster& cluster : clusters)
            if (cluster.isInCut(limit)) cut.push_back(&cluster);
        const double whole = surfaceOf(tileMesh(cut, {{0, 0, 0}, side}, 0, summary, pages), summary.grid);
        double sum = 0;
        double withSkirts = 0;
        for (std::uint64_t x = 0; x < side; x += side / 4)
            for (std::uint64_t y = 0; y < side; y += side / 4)
                for (std::uint64_t z = 0; z < side; z += side / 4) {
                    sum += surfaceOf(tileMesh(cut, {{x, y, z}, side / 4}, 0, summary, pages), summary.grid);
                    withSkirts += surfaceOf(tileMesh(cut, {{x, y, z}, side / 4}, 1000, summary, pages), summary.grid);
                }
        EXPECT_NEAR(sum, whole, 1e-4 * whole) << "places where edges are cut are rounded to the grid";
        EXPECT_GT(withSkirts, sum);
    }
}

TEST_F(Tiles, SkirtsHangFromTheSidesOfCellsAsDeepAsAsked) {
    const hierarchy::ModelFile file(written(4));
    const std::vector<TileCluster> clusters = clustersOf(file, progress);
    PageCache pages(file, mebibytes(1));
    std::vector<const TileCluster*> finest;
    hierarchy::GridBox bounds;
    for (const TileCluster& cluster : clusters) {
        bounds.add(cluster.box);
        if (cluster.isInCut(0)) finest.push_back(&cluster);
    }
    const std::uint64_t side = std::bit_ceil(std::uint64_t{std::max(bounds.max.x, bounds.max.z)} + 1);
    const TileCell cell{{0, 0, 0}, side / 2};
    const CutMesh bare = tileMesh(finest, cell, 0, file.summary(), pages);
    const CutMesh dressed = tileMesh(finest, cell, 64, file.summary(), pages);
    ASSERT_GT(dressed.triangles.size(), bare.triangles.size());
    std::set<std::array<std::uint32_t, 3>> top;
    for (const hierarchy::Vertex& vertex : bare.vertices)
        top.insert({vertex.position.x, vertex.position.y, vertex.position.z});
    for (const hierarchy::Vertex& vertex : dressed.vertices) {
        const std::array<std::uint32_t, 3> hanging{vertex.position.x, vertex.position.y, vertex.position.z};
        if (top.count(hanging) > 0) continue;
        double nearest = 1e9;
        for (const auto& from : top)
            nearest = std::min(
                nearest,
                std::hypot(double(hanging[0]) - from[0], double(hanging[1]) - from[1], double(hanging[2]) - from[2]));
        EXPECT_LE(nearest, 64 + 1);
    }
}

TEST_F(Tiles, PagesComeBackTheSameFromAnyCache) {
    const hierarchy::ModelFile file(written(6));
    PageCache small(file, {1});
    PageCache large(file, gibibytes(1));
    for (int round = 0; round < 3; ++round)
        for (std::uint32_t p = 0; p < file.pages().size(); ++p) {
            const hierarchy::Page plain = file.readPage(p);
            EXPECT_EQ(small.page(p).triangles, plain.triangles);
            EXPECT_EQ(large.page(p).vertices, plain.vertices);
        }
}

struct VolumeBox {
    glm::dvec3 low, high;
};

VolumeBox volumeOf(const json& tile) {
    const json& box = tile["boundingVolume"]["box"];
    const glm::dvec3 middle(box[0], box[1], box[2]);
    const glm::dvec3 half(box[3], box[7], box[11]);
    return {middle - half, middle + half};
}

/// Calls use(tile, parent) for a tile and all below it.
void visitTiles(const json& tile, const json* parent, const std::function<void(const json&, const json*)>& use) {
    use(tile, parent);
    if (tile.contains("children"))
        for (const json& child : tile["children"])
            visitTiles(child, &tile, use);
}

TEST_F(Tiles, BoxesAndErrorsNestAndContentsLieInThem) {
    const std::string model = written(6);
    TilesetOptions options;
    options.tileTriangles = 300;
    const ExportedTileset done = exportTileset(model, options, place + "/t", progress);
    EXPECT_GT(done.levels, 2U);
    const json document = json::parse(readTextFile(place + "/t/tileset.json"));
    EXPECT_EQ(document["asset"]["version"], "1.1");
    EXPECT_EQ(document["root"]["refine"], "REPLACE");
    std::uint64_t contents = 0;
    std::uint64_t leaves = 0;
    visitTiles(document["root"], nullptr, [&](const json& tile, const json* parent) {
        const VolumeBox box = volumeOf(tile);
        if (parent != nullptr) {
            const VolumeBox outer = volumeOf(*parent);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(outer.low, box.low + 1e-9)));
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(outer.high, box.high - 1e-9)));
            EXPECT_LT(tile["geometricError"].get<double>(), (*parent)["geometricError"].get<double>());
        }
        const bool isLeaf = !tile.contains("children");
        EXPECT_EQ(tile["geometricError"] == 0, isLeaf);
        leaves += isLeaf ? 1 : 0;
        if (!tile.contains("content")) return;
        ++contents;
        const auto source =
            read::openMeshSources({place + "/t/" + tile["content"]["uri"].get<std::string>()}, mebibytes(64));
        EXPECT_TRUE(source->summary().hasColors && source->summary().hasNormals);
        source->readVertices([&](const read::VertexBlock& block) {
            for (const glm::dvec3& p : block.positions) {
                const glm::dvec3 turned(p.x, -p.z, p.y); // a viewer turns +y of glTF to the z of tiles
                EXPECT_TRUE(glm::all(glm::lessThanEqual(box.low, turned + 1e-4)));
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.high, turned - 1e-4)));
            }
        });
    });
    EXPECT_EQ(contents, done.tiles);
    EXPECT_GT(leaves, 4U);
    const auto refused = [&](const std::string& folder, const TilesetOptions& how) {
        EXPECT_THROW(exportTileset(model, how, folder, progress), Error) << folder;
    };
    refused(place + "/t", options); // it has something in it
    options.place = glm::dvec3(91, 0, 0);
    refused(place + "/u", options);
}

TEST_F(Tiles, LeavesHaveTheSurfaceOfTheSource) {
    const hierarchy::ModelFile file(written(5));
    TilesetOptions options;
    options.tileTriangles = 200;
    options.hasSkirts = false;
    exportTileset(file.path(), options, place + "/t", progress);
    const json document = json::parse(readTextFile(place + "/t/tileset.json"));
    double area = 0;
    visitTiles(document["root"], nullptr, [&](const json& tile, const json*) {
        if (tile["geometricError"] != 0 || !tile.contains("content")) return;
        const auto source =
            read::openMeshSources({place + "/t/" + tile["content"]["uri"].get<std::string>()}, mebibytes(64));
        std::vector<glm::dvec3> positions;
        source->readVertices([&](const read::VertexBlock& block) {
            positions.insert(positions.end(), block.positions.begin(), block.positions.end());
        });
        source->readTriangles([&](const read::TriangleBlock& block) {
            for (const auto& [a, b, c] : block.triangles)
                area += std::abs(glm::cross(positions[b] - positions[a], positions[c] - positions[a]).y) / 2;
        });
    });
    EXPECT_NEAR(area, 32.0 * 32.0, 0.05) << "a height field over a square";
}

TEST_F(Tiles, AreTheSameBytesForAnyMemoryAndThreads) {
    const std::string model = written(6);
    const auto filesOf = [&](const std::string& folder, Bytes memory) {
        TilesetOptions options;
        options.tileTriangles = 400;
        options.memory = memory;
        const ExportedTileset done = exportTileset(model, options, folder, progress);
        std::map<std::string, std::string> files;
        std::uint64_t bytes = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string name = fs::relative(entry.path(), folder).string();
            files[name] = readTextFile(entry.path().string());
            if (name != "tileset.json") bytes += files[name].size();
        }
        EXPECT_EQ(files.size(), done.tiles + 1);
        EXPECT_EQ(bytes, done.bytes);
        return files;
    };
    EXPECT_THROW(filesOf(place + "/none", {1}), Error);
    // Tight, and still enough for a sanitizer, which keeps freed memory.
    const auto expected = filesOf(place + "/a", {residentSize().count + mebibytes(64).count});
    for (const std::size_t threads : {std::size_t{1}, std::size_t{5}}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(filesOf(place + "/b" + std::to_string(threads), gibibytes(1)), expected);
    }
}

/// The triangles of a .glb as places, each from its least corner on.
std::multiset<std::array<std::array<double, 3>, 3>> trianglesOf(const std::string& path) {
    const auto source = read::openMeshSources({path}, mebibytes(64));
    std::vector<std::array<double, 3>> positions;
    source->readVertices([&](const read::VertexBlock& block) {
        for (const glm::dvec3& p : block.positions)
            positions.push_back({p.x, p.y, p.z});
    });
    std::multiset<std::array<std::array<double, 3>, 3>> triangles;
    source->readTriangles([&](const read::TriangleBlock& block) {
        for (const auto& [a, b, c] : block.triangles) {
            std::array<std::array<double, 3>, 3> corners{positions[a], positions[b], positions[c]};
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            triangles.insert(corners);
        }
    });
    return triangles;
}

TEST_F(Tiles, LeaveNothingWhereTheyAreInterrupted) {
    class Stop final : public Progress {
    public:
        void stage(std::string_view, std::string_view, std::uint64_t) override {}

        void advance(std::uint64_t) override {
            if (--left == 0) throw Interrupted();
        }

        std::atomic<int> left{0};
    };

    const std::string model = written(6);
    TilesetOptions options;
    options.tileTriangles = 300;
    bool isWhole = false;
    for (int steps = 1; !isWhole; steps += 7) {
        Stop stop;
        stop.left = steps;
        try {
            exportTileset(model, options, place + "/t", stop);
            isWhole = true;
        } catch (const Interrupted&) {
            EXPECT_FALSE(fs::exists(place + "/t")) << steps;
        }
    }
    EXPECT_TRUE(fs::exists(place + "/t/tileset.json"));
}

TEST_F(Tiles, PackedOnesHoldTheSame) {
    const std::string model = written(5);
    TilesetOptions options;
    options.tileTriangles = 500;
    const ExportedTileset packed = exportTileset(model, options, place + "/p", progress);
    options.isPacked = false;
    const ExportedTileset plain = exportTileset(model, options, place + "/u", progress);
    EXPECT_EQ(packed.triangles, plain.triangles);
    EXPECT_LT(packed.bytes, plain.bytes);
    EXPECT_EQ(readTextFile(place + "/p/tileset.json"), readTextFile(place + "/u/tileset.json"));
    std::size_t compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(place + "/p/tiles")) {
        if (!entry.is_regular_file()) continue;
        const std::string other = place + "/u/tiles/" + fs::relative(entry.path(), place + "/p/tiles").string();
        EXPECT_EQ(trianglesOf(entry.path().string()), trianglesOf(other));
        ++compared;
    }
    EXPECT_EQ(compared, packed.tiles);
}

TEST_F(Tiles, StandUprightInMetresAtTheirPlace) {
    const std::string model = written(4, [](tests::TinyModel& made) { made.summary.unit = hierarchy::Unit::Foot; });
    TilesetOptions options;
    exportTileset(model, options, place + "/t", progress);
    const json plain = json::parse(readTextFile(place + "/t/tileset.json"))["root"];
    const VolumeBox box = volumeOf(plain);
    EXPECT_NEAR(box.high.x - box.low.x, 16 * 0.3048, 1e-9);
    EXPECT_NEAR(box.low.z, 0, 1e-9) << "the anchor is at the lowest level";
    options.place = glm::dvec3(0, 90, 1000);
    exportTileset(model, options, place + "/e", progress);
    const json transform = json::parse(readTextFile(place + "/e/tileset.json"))["root"]["transform"];
    const std::vector<double> expected = {-1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 6379137, 0, 1};
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_NEAR(transform[i].get<double>(), expected[i], 1e-6) << i;
    options.place = glm::dvec3(90, 0, 0);
    exportTileset(model, options, place + "/p", progress);
    const json pole = json::parse(readTextFile(place + "/p/tileset.json"))["root"]["transform"];
    EXPECT_NEAR(pole[14].get<double>(), 6356752.314, 1e-3) << "the polar radius of WGS84";
    EXPECT_EQ(cutText({0.5, 20, 12}), "20 triangles, 12 vertices, error at most 0.5");
    EXPECT_EQ(tilesetText({3, 2000, 4096, 2}), "3 tiles in 2 levels, 2.0k triangles, 4.00 KiB");
}

} // namespace
} // namespace gnomon::exporter
