// The distances of a point from many triangles at once against those from one after the other, on every kind of
// processor that this one can stand for.
#include "core/random.h"
#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/proximity/triangle_distance.h"
#include "tests/support/each_processor.h"

#include <gtest/gtest.h>

namespace gnomon::proximity {
namespace {

glm::dvec3 randomPosition(Random& random, std::uint64_t kinds) {
    const auto coordinate = [&] {
        return kinds > 0 ? static_cast<double>(random.below(kinds)) : random.uniform(-1, 1);
    };
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
}

/// Triangles of one trial: with few kinds of coordinates there are corners in one place, corners in a row, and points
/// on corners and edges among them.
void expectSame(std::uint64_t seed) {
    Random random(seed);
    const std::uint64_t kinds = random.below(4);
    const std::size_t count = 1 + random.below(TriangleBatch::kCapacity);
    TriangleBatch rows;
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        auto& [a, b, c] = triangles.emplace_back();
        a = randomPosition(random, kinds);
        b = randomPosition(random, kinds);
        c = randomPosition(random, kinds);
        rows.add(a, b, c);
    }
    ASSERT_EQ(rows.count(), count);
    ASSERT_EQ(rows.isFull(), count == TriangleBatch::kCapacity);
    const glm::dvec3 point = randomPosition(random, kinds) * 1.5;
    TriangleBatch::Row squares{};
    rows.squaredDistances(point, squares);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [a, b, c] = triangles[i];
        EXPECT_EQ(squares.at(i), squaredDistance(point, a, b, c)) << "seed " << seed << ", triangle " << i;
    }
}

TEST(NearestKernel, GivesToTheBitWhatOneTriangleAfterTheOtherGives) {
    onEachProcessor([] {
        for (std::uint64_t seed = 0; seed < 4000; ++seed)
            expectSame(seed);
    });
}

} // namespace
} // namespace gnomon::proximity
