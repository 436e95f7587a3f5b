// The first look at a source: counts, the grid that it chooses and why, and what is refused.
#include "core/error.h"
#include "core/random.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/chunk/vertex_lookup.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::chunk {
namespace {

EdgeSample::Lengths lengthsOf(const std::vector<double>& values) {
    EdgeSample::Lengths lengths;
    for (const double value : values)
        lengths.add(value);
    return lengths;
}

TEST(EdgeLengths, AQuantileIsASixteenthOfAPowerOfTwo) {
    const EdgeSample::Lengths lengths = lengthsOf({1, 1.05, 1.5, 2, 3.9, 1024});
    EXPECT_EQ(lengths.quantile(0), 1);
    EXPECT_EQ(lengths.quantile(0.3), 1) << "a third of them are from 1 to 17/16";
    EXPECT_EQ(lengths.quantile(0.34), 1.5);
    EXPECT_EQ(lengths.quantile(0.5), 2);
    EXPECT_EQ(lengths.quantile(0.7), 3.875);
    EXPECT_EQ(lengths.quantile(0.99), 1024);
    EXPECT_EQ(EdgeSample::Lengths().quantile(0.5), 0) << "without edges there is none";
    EXPECT_EQ(lengthsOf({0, -1, std::numeric_limits<double>::quiet_NaN()}).quantile(0.5), 0) << "these are none";
}

TEST(EdgeLengths, AQuantileIsRightWithinOneBinForRandomLengths) {
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<double> values(1 + random.below(2000));
        for (double& value : values)
            value = std::exp(random.uniform(-30, 30));
        const EdgeSample::Lengths lengths = lengthsOf(values);
        std::sort(values.begin(), values.end());
        for (const double fraction : {0.0, 2e-5, 0.1, 0.5, 0.9}) {
            const double exact = values[static_cast<std::size_t>(fraction * static_cast<double>(values.size()))];
            EXPECT_LE(lengths.quantile(fraction), exact);
            EXPECT_GT(lengths.quantile(fraction), exact * 16 / 17.0000001);
        }
    }
}

/// The largest step that all three rules allow.
double largestStep(double extent, double median, double shortest) {
    return std::exp2(std::floor(std::log2(std::min({extent * 0x1p-20, median / 64, shortest / 2}))));
}

TEST(Grid, TheStepIsTheLargestThatTheRulesAllow) {
    Random random(2);
    for (int trial = 0; trial < 500; ++trial) {
        const double extent = std::exp(random.uniform(-20, 20));
        const double median = std::exp2(std::floor(random.uniform(-18, -2))) * std::exp2(std::floor(std::log2(extent)));
        const Box box{{0, 0, 0}, {extent, extent * random.unit(), extent * random.unit()}};
        const hierarchy::Grid grid = chooseGrid(box, box, lengthsOf({median, median, median}));
        const double rule = largestStep(extent, median, median);
        const double min = std::exp2(std::floor(std::log2(extent)) - 29); // of thirty bits
        EXPECT_EQ(grid.step(), std::max(rule, min)) << extent << ' ' << median;
        EXPECT_LE(extent / grid.step(), static_cast<double>(hierarchy::kMaxGridCoordinate));
    }
}

TEST(Grid, NearlyTheShortestEdgeCounts) {
    const Box box{{0, 0, 0}, {1, 1, 1}};
    std::vector<double> lengths(100000, 0.25);
    EXPECT_EQ(chooseGrid(box, box, lengthsOf(lengths)).stepExponent, -20);
    lengths[5] = 0x1p-24;
    lengths[6] = 0x1p-24;
    EXPECT_EQ(chooseGrid(box, box, lengthsOf(lengths)).stepExponent, -20) << "two of a hundred thousand are left out";
    lengths[7] = 0x1p-24;
    EXPECT_EQ(chooseGrid(box, box, lengthsOf(lengths)).stepExponent, -25) << "three are not";
}

TEST(Grid, IsNoFinerThanDoublesAreSpacedFarAway) {
    const Box box{{1e8, 0, 0}, {1e8 + 1, 1, 1}};
    const hierarchy::Grid grid = chooseGrid(box, box, lengthsOf({1e-9}));
    EXPECT_EQ(grid.stepExponent, 26 - 52) << "1e8 lies between 2^26 and 2^27";
    EXPECT_LE(grid.origin.x, 1e8);
    EXPECT_GT(grid.origin.x, 1e8 - grid.step());
    EXPECT_EQ(std::fmod(grid.origin.x, grid.step()), 0) << "the origin is a multiple of the step";
}

TEST(Grid, OfAPointOrOfNothingHasAStepAllTheSame) {
    const Box point{{3, 4, 5}, {3, 4, 5}};
    EXPECT_EQ(chooseGrid(point, point, {}).origin, glm::dvec3(3, 4, 5));
    EXPECT_EQ(chooseGrid(point, point, {}).stepExponent, -20);
    EXPECT_EQ(chooseGrid({}, {}, {}).origin, glm::dvec3(0));
}

TEST(Grid, AStepResolvesTheShortTenthOfTheEdges) {
    // 20 km of rail with long edges, an eighth of them chamfers of 7 mm.
    const Box box{{0, 0, 0}, {20000, 3, 1}};
    std::vector<double> lengths(800, 1.0);
    std::fill_n(lengths.begin(), 100, 0.007);
    EXPECT_LE(chooseGrid(box, box, lengthsOf(lengths)).step(), 0.007 / 64);
    EXPECT_GT(chooseGrid(box, box, lengthsOf(lengths)).step(), 0.007 / 129);
}

TEST(Grid, LiesAroundTheMainPartWhereNotAllIsInRange) {
    const Box part{{5e5, 5.4e6, 400}, {5e5 + 10, 5.4e6 + 10, 401}};
    Box box = part;
    box.add(glm::dvec3(0));
    const EdgeSample::Lengths lengths = lengthsOf({0.003, 0.003, 0.003});
    const hierarchy::Grid grid = chooseGrid(box, part, lengths);
    EXPECT_EQ(grid.step(), 0x1p-17) << "2^-20 of 10 m";
    EXPECT_TRUE(GridSnap(grid).isInRange(part.min));
    EXPECT_TRUE(GridSnap(grid).isInRange(part.max));
    EXPECT_FALSE(GridSnap(grid).isInRange(box.min));
    EXPECT_EQ(chooseGrid(box, box, lengths).step(), 0x1p-7) << "all of it: 5.4e6 in 30 bits";
    EXPECT_TRUE(GridSnap(chooseGrid(box, box, lengths)).isInRange(box.min));
    // What the grid can contain without a coarser step stays in its range.
    Box near = part;
    near.add(part.min - glm::dvec3(3000));
    EXPECT_EQ(chooseGrid(near, part, lengths).step(), 0x1p-17);
    EXPECT_TRUE(GridSnap(chooseGrid(near, part, lengths)).isInRange(near.min));
}

/// A sheet of `cells` x `cells` and `strays` triangles as wide as its cells, `distance` from its middle.
read::CodeMesh sheetWithStrays(std::uint32_t cells, std::uint32_t strays, double distance) {
    const read::CodeMesh sheet = read::bumpySheet(cells);
    std::vector<glm::dvec3> positions = sheet.positions;
    std::vector<read::CodeMesh::Triangle> triangles = sheet.triangles;
    for (std::uint32_t i = 0; i < strays; ++i) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const glm::dvec2& corner : {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(0, 1)})
            positions.emplace_back(0.5 - distance + corner.x / cells, 0.5 + corner.y / cells, 0);
        triangles.push_back({first, first + 1, first + 2});
    }
    return {std::move(positions), std::move(triangles)};
}

Box mainPartOf(read::CodeMesh mesh) {
    NoProgress progress;
    return surveySource(mesh, progress).mainPart;
}

TEST(MainPart, HoldsAllButAFewTrianglesThatAreFarAway) {
    const Box sheet = mainPartOf(read::bumpySheet(40)); // 3,200 triangles
    const auto isSheet = [&](const Box& part) {
        return part.extent().x >= sheet.extent().x && part.extent().x < 1.1 * sheet.extent().x;
    };
    EXPECT_TRUE(isSheet(mainPartOf(sheetWithStrays(40, 3, 5)))) << "three of 3,203 are a thousandth";
    EXPECT_FALSE(isSheet(mainPartOf(sheetWithStrays(40, 4, 5)))) << "four are more";
    EXPECT_FALSE(isSheet(mainPartOf(sheetWithStrays(40, 3, 1)))) << "they lie beside it";
    EXPECT_TRUE(isSheet(mainPartOf(sheetWithStrays(40, 16, 2000)))) << "few triangles very far away";
    EXPECT_FALSE(isSheet(mainPartOf(sheetWithStrays(40, 17, 2000))));
    EXPECT_FALSE(isSheet(mainPartOf(sheetWithStrays(40, 16, 500))));
    EXPECT_TRUE(isSheet(mainPartOf(sheetWithStrays(2, 1, 2000)))) << "one of nine";
    EXPECT_FALSE(isSheet(mainPartOf(sheetWithStrays(2, 2, 2000)))) << "two of ten are more than an eighth";
}

TEST(EdgeSample, IsAllOfASmallSource) {
    read::CodeMesh mesh = read::bumpySheet(10);
    EdgeSample sample;
    for (std::uint64_t i = 0; i < mesh.triangles.size(); ++i)
        sample.offer(i, {mesh.triangles[i][0], mesh.triangles[i][1], mesh.triangles[i][2]});
    EdgeSample::Lengths all;
    for (const read::CodeMesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            all.add(glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]));
    const EdgeSample::Lengths found = sample.measure(VertexLookup(mesh, sample.vertices()));
    for (const double fraction : {0.0, 0.25, 0.5, 0.75, 0.99})
        EXPECT_EQ(found.quantile(fraction), all.quantile(fraction));
}

TEST(EdgeSample, OfALargeSourceIsAFairPart) {
    // Every third triangle is ten times as large; a sample that took the first would see another share of them.
    std::vector<glm::dvec3> positions;
    for (const double size : {1.0, 10.0})
        for (const glm::dvec3& corner : {glm::dvec3(0), glm::dvec3(size, 0, 0), glm::dvec3(0, size, 0)})
            positions.push_back(corner);
    read::CodeMesh mesh(positions, {{0, 1, 2}, {3, 4, 5}});
    EdgeSample sample;
    for (std::uint64_t i = 0; i < 2000000; ++i)
        sample.offer(i, i % 3 == 0 ? read::TriangleCorners{3, 4, 5} : read::TriangleCorners{0, 1, 2});
    const EdgeSample::Lengths lengths = sample.measure(VertexLookup(mesh, sample.vertices()));
    EXPECT_EQ(lengths.quantile(0.66), 1.375) << "most of the square root of 2";
    EXPECT_EQ(lengths.quantile(0.673), 10);
}

// Whatever parts leave out the whole would have left out, and they do not offer much more.
TEST(EdgeSample, OfPartsIsThatOfTheWhole) {
    for (const std::uint64_t triangles : {520'000U, 530'000U, 1'045'000U, 1'075'000U}) {
        EdgeSample whole;
        EdgeSample joined;
        std::array parts{EdgeSample(triangles), EdgeSample(triangles), EdgeSample(triangles)};
        for (std::uint64_t i = 0; i < triangles; ++i) {
            whole.offer(i, {i, 1, 2});
            parts[i * parts.size() / triangles].offer(i, {i, 1, 2});
        }
        std::size_t offered = 0;
        for (const EdgeSample& part : parts) {
            offered += part.entries().size();
            for (const EdgeSample::Entry& entry : part.entries())
                joined.take(entry);
        }
        EXPECT_LE(offered, 540'000U) << triangles;
        ASSERT_EQ(joined.entries().size(), whole.entries().size()) << triangles;
        for (std::size_t i = 0; i < whole.entries().size(); ++i)
            ASSERT_EQ(joined.entries()[i].corners, whole.entries()[i].corners) << triangles;
    }
}

TEST(Survey, CountsTrianglesVerticesAndValences) {
    read::CodeMesh mesh = read::bumpySheet(20);
    mesh.positions.emplace_back(1e30, 0, std::numeric_limits<double>::quiet_NaN()); // of no triangle
    read::CodeMesh stray(mesh.positions, mesh.triangles);
    NoProgress progress;
    const SourceSurvey survey = surveySource(stray, progress);
    EXPECT_EQ(survey.triangles, 800U);
    EXPECT_EQ(survey.vertices, 442U);
    EXPECT_FALSE(survey.hasPolygons);
    std::vector<std::uint32_t> valence(442);
    for (const read::CodeMesh::Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t)
            ++valence[v];
    for (std::size_t v = 0; v < valence.size(); ++v)
        EXPECT_EQ(survey.valence[v], valence[v]);
    EXPECT_EQ(survey.valence[441], 0) << "and sets no bounds";
    hierarchy::GridPoint furthest;
    for (std::size_t v = 0; v + 1 < mesh.positions.size(); ++v) {
        const hierarchy::GridPoint p = GridSnap(survey.grid)(mesh.positions[v]);
        furthest = {std::max(furthest.x, p.x), std::max(furthest.y, p.y), std::max(furthest.z, p.z)};
    }
    EXPECT_EQ(survey.furthest, furthest);
}

TEST(Survey, AValenceIsCountedUpTo255) {
    std::vector<glm::dvec3> positions{{0, 0, 0}};
    std::vector<read::CodeMesh::Triangle> triangles;
    for (std::uint32_t i = 0; i < 300; ++i) {
        positions.emplace_back(std::cos(0.02 * i), std::sin(0.02 * i), 0);
        if (i > 0) triangles.push_back({0, i, i + 1});
    }
    read::CodeMesh fan(positions, triangles);
    NoProgress progress;
    EXPECT_EQ(surveySource(fan, progress).valence[0], 255);
}

TEST(Survey, CoordinatesThatAreNoneOrTooLargeAreRefused) {
    NoProgress progress;
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e101}) {
        read::CodeMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, bad, 0}}, {{0, 1, 2}});
        EXPECT_THROW(surveySource(mesh, progress), Error) << bad;
    }
    read::CodeMesh large({{0, 0, 0}, {1, 0, 0}, {0, 1e100, 0}}, {{0, 1, 2}});
    EXPECT_EQ(surveySource(large, progress).triangles, 1U);
}

TEST(VertexLookup, FetchesWhatIsAskedForInAnyOrder) {
    read::CodeMesh mesh = read::bumpySheet(200); // more than a block of vertices
    Random random(3);
    std::vector<std::uint64_t> wanted{0, mesh.positions.size() - 1};
    for (int i = 0; i < 500; ++i)
        wanted.push_back(random.below(mesh.positions.size()));
    wanted.push_back(wanted[7]);
    const VertexLookup lookup(mesh, wanted);
    for (const std::uint64_t vertex : wanted)
        EXPECT_EQ(lookup[vertex], mesh.positions[vertex]);
    const VertexLookup none(mesh, {});
}

} // namespace
} // namespace gnomon::chunk
