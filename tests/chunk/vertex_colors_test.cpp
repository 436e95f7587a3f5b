// The weld of a chunk where vertices of several colours meet in one place.
#include "core/angle.h"
#include "core/random.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "tests/support/shared_borders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon::chunk {
namespace {

/// Triangles around the origin, each with three vertices of its own, all of one of five colours.
class ColoredFan final : public read::MeshSource {
public:
    explicit ColoredFan(std::uint32_t count) {
        Random random(3);
        for (std::uint32_t t = 0; t < count; ++t) {
            const auto color = static_cast<std::uint32_t>(0xFF000000U + random.below(5));
            for (const double at : {-1.0, t / 1.0, t + 1.0}) {
                const double angle = 2 * kPi * at / count;
                positions_.push_back(at < 0 ? glm::dvec3(0) : glm::dvec3(std::cos(angle), std::sin(angle), 0));
                colors_.push_back(color);
            }
            const std::uint64_t first = positions_.size() - 3;
            corners_.push_back({first, first + 1, first + 2});
        }
        summary_.vertexCount = positions_.size();
        summary_.faceCount = corners_.size();
        summary_.isDouble = summary_.hasColors = true;
    }

    const read::MeshSummary& summary() const override { return summary_; }

    void readVertices(const read::VertexSink& sink) override { sink({0, positions_, {}, colors_, {}}); }

    void readTriangles(const read::TriangleSink& sink) override { sink({0, corners_, {}, 0}); }

    std::span<const std::uint32_t> colors() const { return colors_; }

private:
    read::MeshSummary summary_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> colors_;
    std::vector<read::TriangleCorners> corners_;
};

TEST(Chunks, HaveEachColourAtAPlaceOnceAndTrianglesKeepTheirs) {
    constexpr std::uint32_t kCount = 60;
    ColoredFan fan(kCount);
    NoProgress progress;
    SourceSurvey survey = surveySource(fan, progress);
    const ChunkTree tree = planChunks(fan, survey, 1000, progress);
    ASSERT_EQ(tree.chunkCount(), 1U);
    scratch::TemporarySpace space(progress);
    const auto binsFile = scratch::scratchInMemory(space);
    scratch::StreamStore bins(*binsFile, binStreams(1), 4096);
    binSource(fan, survey, tree, bins, 10, progress);
    const auto bordersFile = scratch::scratchInMemory(space);
    scratch::StreamStore borders(*bordersFile, borderStreams(1), 4096);
    const BinnedSource source{bins, survey.grid, formatOf(fan.summary()), 1};
    shareBorders(source, borders, progress);
    const simplify::Mesh mesh = loadChunk(source, borders, 0, progress).mesh;

    ASSERT_EQ(mesh.triangles.size(), kCount);
    std::multiset<std::uint32_t> found;
    for (const simplify::Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            ASSERT_LT(v, mesh.vertices.size());
            EXPECT_EQ(mesh.vertices[v].color, mesh.vertices[t[0]].color);
        }
        found.insert(mesh.vertices[t[0]].color);
    }
    std::multiset<std::uint32_t> expected;
    for (std::size_t t = 0; t < kCount; ++t)
        expected.insert(fan.colors()[3 * t]);
    EXPECT_EQ(found, expected);
    std::map<hierarchy::GridPoint, std::set<std::uint32_t>> colorsAt;
    std::map<hierarchy::GridPoint, std::uint32_t> placeOf;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const hierarchy::Vertex& vertex = mesh.vertices[v];
        EXPECT_TRUE(colorsAt[vertex.position].insert(vertex.color).second) << "twice in one place";
        EXPECT_EQ(placeOf.try_emplace(vertex.position, mesh.positionOf[v]).first->second, mesh.positionOf[v]);
    }
    EXPECT_EQ(mesh.positionCount, kCount + 1);
    const auto max = std::max_element(colorsAt.begin(), colorsAt.end(), [](const auto& a, const auto& b) {
        return a.second.size() < b.second.size();
    });
    EXPECT_EQ(max->second.size(), 5U) << "all meet in the middle";
}

} // namespace
} // namespace gnomon::chunk
