// The tree of points against a look at each of them.
#include "core/random.h"
#include "hierarchy/model.h"
#include "preprocess/proximity/point_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::proximity {
namespace {

struct Points {
    std::vector<glm::dvec3> places;
    std::vector<std::uint32_t> components;

    std::uint32_t nearestPlainly(const glm::dvec3& place, std::uint32_t component) const {
        std::uint32_t best = hierarchy::kNone;
        double min = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            const glm::dvec3 d = places[i] - place;
            if (components[i] == component || glm::dot(d, d) >= min) continue;
            min = glm::dot(d, d);
            best = i;
        }
        return best;
    }
};

/// On a lattice of `size` steps a side, with many ties; where `isFlat`, all in one plane.
Points latticePoints(std::size_t count, std::uint64_t size, std::uint64_t components, bool isFlat, Random& random) {
    Points points;
    const auto middle = static_cast<double>(size) * 0.5;
    const auto step = [&] { return static_cast<double>(random.below(size)) - middle; };
    for (std::size_t i = 0; i < count; ++i) {
        const double x = step();
        const double y = step();
        points.places.emplace_back(x, y, isFlat ? 5 : step());
        points.components.push_back(static_cast<std::uint32_t>(random.below(components)));
    }
    return points;
}

TEST(PointTree, FindsTheNearestOfAnotherPiece) {
    Random random(3);
    for (const std::size_t count : {0U, 1U, 12U, 13U, 40U, 700U})
        for (const std::uint64_t size : {1U, 2U, 9U, 4000U})
            for (const std::uint64_t components : {1U, 2U, 50U})
                for (const bool isFlat : {false, true}) {
                    const Points points = latticePoints(count, size, components, isFlat, random);
                    const PointTree tree(points.places, points.components);
                    for (std::size_t i = 0; i < count; ++i)
                        ASSERT_EQ(
                            tree.nearest(points.places[i], points.components[i]),
                            points.nearestPlainly(points.places[i], points.components[i]));
                    const glm::dvec3 aside(0.3, -7, 1e5);
                    ASSERT_EQ(tree.nearest(aside, 0), points.nearestPlainly(aside, 0));
                }
}

TEST(PointTree, TakesNeighboursAmongNumbers) {
    Points points;
    for (std::uint32_t i = 0; i < 100; ++i) {
        points.places.emplace_back(i % 2 == 0 ? 1 : std::nextafter(1.0, 2), 0, 0);
        points.components.push_back(i % 3);
    }
    const PointTree tree(points.places, points.components);
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(
            tree.nearest(points.places[i], points.components[i]),
            points.nearestPlainly(points.places[i], points.components[i]));
}

} // namespace
} // namespace gnomon::proximity
