// The estimates for many collapses at once against those for one after the other, on every kind of processor that this
// one can stand for.
#include "core/random.h"
#include "hierarchy/octahedral.h"
#include "preprocess/simplify/cost_estimate.h"
#include "tests/proximity/each_processor.h"

#include <gtest/gtest.h>

namespace gnomon::simplify {
namespace {

constexpr std::uint32_t kPositions = 24;

struct Kind {
    bool hasNormals;
    bool hasColors;
    bool isFlat; // all in a row: no planes
};

glm::dvec3 randomVector(Random& random) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    return {x, y, random.uniform(-1, 1)};
}

/// Triangles strewn among positions of one vertex each, of which some have no normal and some no triangle.
Patch randomPatch(Random& random, const Kind& kind) {
    Patch patch;
    for (std::uint32_t p = 0; p < kPositions; ++p) {
        patch.positions.push_back(kind.isFlat ? glm::dvec3(p, 0, 0) : randomVector(random) * 100.0);
        patch.isLocked.push_back(0);
        patch.positionOf.push_back(p);
        hierarchy::Vertex& vertex = patch.vertices.emplace_back();
        const bool isSmooth = kind.hasNormals && random.below(4) != 0;
        vertex.normal = isSmooth ? hierarchy::packNormal(randomVector(random)) : hierarchy::kNoNormal;
        vertex.color = kind.hasColors ? static_cast<std::uint32_t>(random.below(1U << 24U)) : 0;
    }
    while (patch.triangles.size() < 30) {
        const auto a = static_cast<std::uint32_t>(random.below(kPositions - 2));
        const auto b = static_cast<std::uint32_t>(random.below(kPositions - 2));
        const auto c = static_cast<std::uint32_t>(random.below(kPositions - 2));
        if (a != b && b != c && c != a) patch.triangles.push_back({a, b, c});
    }
    return patch;
}

void expectSame(std::uint64_t seed, const Kind& kind) {
    Random random(seed);
    const Patch patch = randomPatch(random, kind);
    CostEstimate estimate(patch, SimplificationMesh(patch));
    for (std::uint32_t from = 0; from < kPositions; ++from) {
        std::vector<std::uint32_t> to(random.below(20));
        for (std::uint32_t& q : to)
            q = static_cast<std::uint32_t>(random.below(kPositions));
        const std::span<const double> squares = estimate.squares(from, to);
        ASSERT_EQ(squares.size(), to.size());
        for (std::size_t i = 0; i < to.size(); ++i)
            EXPECT_EQ(squares[i], estimate.square(from, to[i])) << "seed " << seed << ", " << from << " to " << to[i];
    }
}

TEST(CostEstimate, GivesToTheBitForManyWhatItGivesForOneAfterTheOther) {
    proximity::onEachProcessor([] {
        for (std::uint64_t seed = 0; seed < 50; ++seed)
            for (const Kind kind :
                 {Kind{true, false, false}, {true, true, false}, {false, true, false}, {true, true, true}})
                expectSame(seed, kind);
    });
}

} // namespace
} // namespace gnomon::simplify
