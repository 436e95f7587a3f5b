// Chunks beside a plain weld of the whole mesh at once: the same triangles, vertices, normals and counts.
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/chunk/binned_source.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/levels/smooth_normals.h"
#include "tests/support/code_mesh.h"
#include "tests/support/shared_borders.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace gnomon::chunk {

namespace {

using Corners = std::array<hierarchy::Vertex, 3>;

/// Starting with its least corner, so that turns of one triangle are the same.
Corners turned(Corners corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

hierarchy::GridPoint plainlySnapped(const hierarchy::Grid& grid, const glm::dvec3& position) {
    std::array<std::uint32_t, 3> p{};
    for (int axis = 0; axis < 3; ++axis) {
        const double nearest = std::floor((position[axis] - grid.origin[axis]) / grid.step() + 0.5);
        if (nearest > hierarchy::kMaxGridCoordinate)
            p[static_cast<std::size_t>(axis)] = hierarchy::kMaxGridCoordinate;
        else if (nearest > 0)
            p[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(nearest);
    }
    return {p[0], p[1], p[2]};
}

struct Facts {
    std::multiset<Corners> triangles;
    std::array<std::uint64_t, 3> dropped{}; // degenerate, collapsed by the grid, doubled
};

/// All in memory with maps: the slow way that is obviously right.
Facts plainFacts(const read::CodeMesh& mesh, const hierarchy::Grid& grid) {
    Facts facts;
    std::map<hierarchy::GridPoint, std::uint32_t> ids;
    std::vector<hierarchy::GridPoint> points;
    const auto idOf = [&](std::uint32_t vertex) {
        const hierarchy::GridPoint p = plainlySnapped(grid, mesh.positions[vertex]);
        const auto [place, isNew] = ids.emplace(p, static_cast<std::uint32_t>(points.size()));
        if (isNew) points.push_back(p);
        return place->second;
    };
    const auto at = [&](std::uint32_t vertex) {
        const glm::dvec3& p = mesh.positions[vertex];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    std::set<simplify::Triangle> seen;
    std::vector<simplify::Triangle> kept;
    for (const simplify::Triangle& t : mesh.triangles) {
        const simplify::Triangle p{idOf(t[0]), idOf(t[1]), idOf(t[2])};
        simplify::Triangle sorted = p;
        std::sort(sorted.begin(), sorted.end());
        const std::set<std::array<double, 3>> corners{at(t[0]), at(t[1]), at(t[2])};
        if (corners.size() < 3)
            ++facts.dropped[0];
        else if (sorted[0] == sorted[1] || sorted[1] == sorted[2])
            ++facts.dropped[1];
        else if (!seen.insert(sorted).second)
            ++facts.dropped[2];
        else
            kept.push_back(p);
    }
    const std::vector<std::uint32_t> normals = levels::smoothNormals(points, kept);
    for (const simplify::Triangle& t : kept) {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = {points[t[i]], normals[t[i]], 0xFFFFFFFFU};
        facts.triangles.insert(turned(corners));
    }
    return facts;
}

struct Chunked {
    SourceSurvey survey;
    std::uint32_t chunkCount = 0;
    BinnedSize size;
    std::vector<ChunkMesh> chunks;
};

Chunked chunked(read::CodeMesh mesh, std::uint32_t chunkTriangles, std::size_t block) {
    NoProgress progress;
    Chunked result;
    result.survey = surveySource(mesh, progress);
    const ChunkTree tree = planChunks(mesh, result.survey, chunkTriangles, progress);
    result.chunkCount = tree.chunkCount();
    scratch::TemporarySpace space(progress);
    const auto binsFile = scratch::scratchInMemory(space);
    scratch::StreamStore bins(*binsFile, binStreams(tree.chunkCount()), block);
    const BinnedSize measured = measureBins(mesh, result.survey, tree, progress);
    result.size = binSource(mesh, result.survey, tree, bins, 10, progress);
    EXPECT_EQ(measured.largestChunk.triangles, result.size.largestChunk.triangles);
    EXPECT_EQ(measured.largestChunk.vertices, result.size.largestChunk.vertices);
    const auto bordersFile = scratch::scratchInMemory(space);
    scratch::StreamStore borders(*bordersFile, borderStreams(tree.chunkCount()), block);
    const BinnedSource source{bins, result.survey.grid, formatOf(mesh.summary()), tree.chunkCount()};
    shareBorders(source, borders, progress);
    for (std::uint32_t chunk = 0; chunk < tree.chunkCount(); ++chunk)
        result.chunks.push_back(loadChunk(source, borders, chunk, progress));
    return result;
}

/// A crumpled soup: vertices of its own for every triangle, some doubled, some without area, corners on a coarse
/// lattice so that many meet.
read::CodeMesh soup(std::uint64_t seed, std::uint32_t triangles) {
    Random random(seed);
    std::vector<glm::dvec3> positions;
    std::vector<simplify::Triangle> corners;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        for (int i = 0; i < 3; ++i) {
            const auto x = static_cast<double>(random.below(12));
            const auto y = static_cast<double>(random.below(12));
            const auto z = static_cast<double>(random.below(3));
            positions.emplace_back(x, y, z);
        }
        corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return {std::move(positions), std::move(corners)};
}

void expectSameFacts(const read::CodeMesh& mesh, std::uint32_t chunkTriangles, std::size_t block) {
    const Chunked chunked = chunk::chunked(mesh, chunkTriangles, block);
    const Facts expected = plainFacts(mesh, chunked.survey.grid);
    std::multiset<Corners> triangles;
    const DroppedTriangles& first = chunked.size.dropped;
    std::array<std::uint64_t, 3> dropped{first.degenerate, first.collapsedByGrid, first.doubled};
    std::map<hierarchy::GridPoint, std::set<std::uint32_t>> chunksAt;
    for (std::uint32_t c = 0; c < chunked.chunkCount; ++c) {
        const ChunkMesh& chunk = chunked.chunks[c];
        dropped[0] += chunk.dropped.degenerate;
        dropped[1] += chunk.dropped.collapsedByGrid;
        dropped[2] += chunk.dropped.doubled;
        for (const simplify::Triangle& t : chunk.mesh.triangles) {
            triangles.insert(turned({chunk.mesh.vertices[t[0]], chunk.mesh.vertices[t[1]], chunk.mesh.vertices[t[2]]}));
            for (const std::uint32_t v : t)
                chunksAt[chunk.mesh.vertices[v].position].insert(c);
        }
    }
    EXPECT_TRUE(triangles == expected.triangles);
    EXPECT_EQ(dropped, expected.dropped);
    // Who has a position that others have, too, must know it.
    for (std::uint32_t c = 0; c < chunked.chunkCount; ++c) {
        const simplify::Mesh& part = chunked.chunks[c].mesh;
        for (std::size_t v = 0; v < part.vertices.size(); ++v) {
            const auto found = chunksAt.find(part.vertices[v].position);
            ASSERT_NE(found, chunksAt.end());
            const std::set<std::uint32_t>& all = found->second;
            EXPECT_TRUE(all.size() == 1 || part.isBorder[part.positionOf[v]] != 0);
        }
    }
}

TEST(Chunks, TogetherAreTheWholeWeldedMesh) {
    expectSameFacts(read::bumpySheet(40), 300, 64);
    expectSameFacts(read::bumpySheet(40), 100, 1000);
    expectSameFacts(read::bumpySheet(10), 10'000, 64);
    expectSameFacts(read::strewnBoxes(200), 150, 512);
    for (std::uint64_t seed = 0; seed < 12; ++seed)
        expectSameFacts(soup(seed, 1500), 64 + 50 * static_cast<std::uint32_t>(seed), 256);
}

/// Triangles with vertices of their own between few places, at each of which some lie a little aside, within a point
/// of the grid.
read::CodeMesh coincident(std::uint64_t seed, std::uint32_t triangles, std::uint64_t aside) {
    Random random(seed);
    const std::array<glm::dvec3, 5> places{{{0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {5, 5, 5}, {5, 5.001, 5}}};
    std::vector<glm::dvec3> positions;
    std::vector<simplify::Triangle> corners;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        for (int i = 0; i < 3; ++i)
            positions.push_back(
                places[random.below(5)] + glm::dvec3(static_cast<double>(random.below(aside)), 0, 0) * 1e-9);
        corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        if (random.below(10) == 0) corners.back()[2] = corners.back()[0];
    }
    return {std::move(positions), std::move(corners)};
}

TEST(Chunks, OfCoincidentTrianglesAreTheWholeWeldedMesh) {
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        for (const std::uint64_t aside : {1U, 2U, 4U})
            expectSameFacts(coincident(seed, 1500, aside), 64 + 150 * static_cast<std::uint32_t>(seed), 256);
}

TEST(Chunks, DoNotGrowWithCopiesOfATriangle) {
    const Chunked chunked = chunk::chunked(coincident(1, 30'000, 1), 10'000, 4096);
    EXPECT_LT(chunked.size.largestChunk.triangles, 100U);
    EXPECT_LT(chunked.size.largestChunk.vertices, 200U);
}

TEST(GridSnap, FindsTheNearestPointOfTheGrid) {
    Random random(3);
    for (int i = 0; i < 20'000; ++i) {
        hierarchy::Grid grid;
        grid.stepExponent = static_cast<int>(random.below(60)) - 40;
        const auto coordinate = [&](double spread) { return random.uniform(-spread, spread); };
        grid.origin = glm::dvec3(coordinate(50), coordinate(50), coordinate(50));
        const double spread = std::ldexp(grid.step(), static_cast<int>(random.below(36))); // some lie beyond the grid
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = grid.origin[axis] + coordinate(spread);
        if (random.below(4) == 0) // just between two points
            position = grid.origin + (glm::floor((position - grid.origin) / grid.step()) + 0.5) * grid.step();
        ASSERT_EQ(GridSnap(grid)(position), plainlySnapped(grid, position));
    }
}

/// Seeded vertices of a chunk: runs of consecutive indices with gaps between, some of them foreign.
struct MadeVertices {
    std::vector<ChunkVertex> own;
    std::vector<ChunkVertex> foreign; // in no order
};

MadeVertices madeVertices(Random& random) {
    MadeVertices made;
    const std::uint64_t longestRun = 1 + random.below(40);
    const std::uint64_t widestGap = 1 + random.below(std::uint64_t{1} << random.below(20));
    std::uint64_t index = random.below(1000);
    for (std::uint64_t run = random.below(200); run > 0; --run) {
        std::vector<ChunkVertex>& some = random.below(4) == 0 ? made.foreign : made.own;
        for (std::uint64_t left = 1 + random.below(longestRun); left > 0; --left) {
            some.emplace_back();
            some.back().index = index++;
        }
        index += random.below(widestGap);
    }
    if (random.below(8) == 0) {
        made.own.emplace_back();
        made.own.back().index = random.below(2) == 0 ? 0xFFFFFFFE : std::uint64_t{1} << 40U;
    }
    for (std::size_t i = made.foreign.size(); i > 1; --i)
        std::swap(made.foreign[i - 1], made.foreign[random.below(i)]);
    return made;
}

TEST(IndexedVertices, AreFoundAsInAMap) {
    Random random(11);
    for (int i = 0; i < 300; ++i) {
        const MadeVertices made = madeVertices(random);
        std::map<std::uint64_t, std::uint32_t> plain;
        for (const std::vector<ChunkVertex>* some : {&made.own, &made.foreign})
            for (const ChunkVertex& vertex : *some)
                plain.emplace(vertex.index, static_cast<std::uint32_t>(plain.size()));
        std::vector<ChunkVertex> all = made.own;
        all.insert(all.end(), made.foreign.begin(), made.foreign.end());
        const IndexedVertices vertices(std::move(all), made.own.size());
        ASSERT_EQ(vertices.size(), plain.size());
        ASSERT_EQ(vertices.ownCount(), made.own.size());
        for (const auto& [index, vertex] : plain) {
            ASSERT_EQ(vertices.find(index), vertex);
            ASSERT_EQ(vertices[vertex].index, index);
        }
    }
}

TEST(IndexedVerticesDeathTest, OneThatIsNotThereIsNotFound) {
    const auto at = [](std::uint32_t index) {
        ChunkVertex vertex;
        vertex.index = index;
        return vertex;
    };
    const IndexedVertices vertices({at(5), at(6), at(9), at(2)}, 3);
    for (const std::uint32_t absent : {0U, 1U, 3U, 4U, 7U, 8U, 10U, 0xFFFFFFFFU})
        EXPECT_DEATH(vertices.find(absent), "internal check failed") << absent;
    EXPECT_DEATH(IndexedVertices({}, 0).find(0), "internal check failed");
}

TEST(Chunks, MostBordersAreInteriorElsewhere) {
    const Chunked chunked = chunk::chunked(read::bumpySheet(60), 1000, 4096);
    EXPECT_GE(chunked.chunkCount, 7U);
    std::size_t borders = 0;
    std::size_t positions = 0;
    for (const ChunkMesh& chunk : chunked.chunks)
        for (std::uint32_t p = 0; p < chunk.mesh.positionCount; ++p, ++positions)
            borders += chunk.mesh.isBorder[p] != 0 ? 1U : 0U;
    EXPECT_GT(borders, 0U);
    EXPECT_LT(borders, positions / 2);
}

TEST(Chunks, AreCutByWeightAlongTheOctree) {
    const read::CodeMesh sheet = read::bumpySheet(100);
    for (const std::uint32_t limit : {200U, 1000U, 5000U}) {
        const Chunked chunked = chunk::chunked(sheet, limit, 4096);
        for (const ChunkMesh& chunk : chunked.chunks)
            EXPECT_LE(chunk.mesh.triangles.size(), limit + limit / 2); // corners are counted where they lie
        EXPECT_LE(chunked.chunkCount, 2 + 2 * sheet.triangles.size() / limit);
    }
}

/// A source of one quad mesh, whose polygons cross the chunks.
class QuadSheet final : public read::MeshSource {
public:
    explicit QuadSheet(std::uint32_t n) : n_(n) {
        summary_.path = "quads";
        summary_.vertexCount = std::uint64_t{n + 1} * (n + 1);
        summary_.faceCount = std::uint64_t{n} * n;
        summary_.isDouble = true;
    }

    const read::MeshSummary& summary() const override { return summary_; }

    void readVertices(const read::VertexSink& sink) override {
        std::vector<glm::dvec3> positions;
        for (std::uint32_t y = 0; y <= n_; ++y)
            for (std::uint32_t x = 0; x <= n_; ++x)
                positions.emplace_back(x + (y % 2 == 1 && x > 0 && x < n_ ? 0.9 : 0), y, 0);
        read::VertexBlock block;
        block.positions = positions;
        sink(block);
    }

    void readTriangles(const read::TriangleSink& sink) override {
        std::vector<read::TriangleCorners> triangles;
        std::vector<read::PolygonRun> polygons;
        for (std::uint64_t y = 0; y < n_; ++y)
            for (std::uint64_t x = 0; x < n_; ++x) {
                const std::uint64_t a = y * (n_ + 1) + x;
                polygons.push_back({static_cast<std::uint32_t>(triangles.size()), 2});
                triangles.push_back({a, a + 1, a + n_ + 2});
                triangles.push_back({a, a + n_ + 2, a + n_ + 1});
            }
        read::TriangleBlock block;
        block.triangles = triangles;
        block.polygons = polygons;
        sink(block);
    }

private:
    std::uint32_t n_;
    read::MeshSummary summary_;
};

TEST(Chunks, PolygonsAcrossChunksAreCutLikeThoseWithin) {
    std::set<std::vector<std::uint64_t>> results;
    for (const std::uint32_t chunkTriangles : {100'000U, 400U, 64U}) {
        QuadSheet source(40);
        NoProgress progress;
        SourceSurvey survey = surveySource(source, progress);
        const ChunkTree tree = planChunks(source, survey, chunkTriangles, progress);
        scratch::TemporarySpace space(progress);
        const auto file = scratch::scratchInMemory(space);
        scratch::StreamStore bins(*file, binStreams(tree.chunkCount()), 100);
        const PartSize measured = measureBins(source, survey, tree, progress).largestChunk;
        const PartSize binned = binSource(source, survey, tree, bins, 40, progress).largestChunk;
        EXPECT_GE(measured.triangles, binned.triangles);
        EXPECT_GE(measured.vertices, binned.vertices);
        const auto bordersFile = scratch::scratchInMemory(space);
        scratch::StreamStore borders(*bordersFile, borderStreams(tree.chunkCount()), 100);
        const BinnedSource inChunks{bins, survey.grid, formatOf(source.summary()), tree.chunkCount()};
        shareBorders(inChunks, borders, progress);
        std::vector<std::uint64_t> triangles; // as hashes of their points
        for (std::uint32_t c = 0; c < tree.chunkCount(); ++c) {
            const simplify::Mesh mesh = loadChunk(inChunks, borders, c, progress).mesh;
            for (const simplify::Triangle& t : mesh.triangles) {
                const Corners corners = turned({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
                std::uint64_t hash = 0;
                for (const hierarchy::Vertex& v : corners)
                    hash = mix64(hash + mix64(v.position.x) + v.position.y + v.normal);
                triangles.push_back(hash);
            }
        }
        std::sort(triangles.begin(), triangles.end());
        results.insert(triangles);
    }
    EXPECT_EQ(results.size(), 1U);
    EXPECT_EQ(results.begin()->size(), 3200U);
}

} // namespace
} // namespace gnomon::chunk
