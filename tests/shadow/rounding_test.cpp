// Theory and set-up under every rounding mode, and what no build may take away from floating point.
#include "rounding_cases.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

namespace gnomon::shadow {
namespace {

TEST(Rounding, ModesChangeNoSetUpUnreported) {
    Random random(asked("GNOMON_ROUNDING_SEED", 1));
    RoundingCounts counts;
    for (std::uint64_t i = asked("GNOMON_ROUNDING_VIEWS", 1500); i > 0 && !testing::Test::HasFailure(); --i) {
        SCOPED_TRACE(counts.views);
        expectSame<tests::RoundingMode>(random, {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}, counts);
    }
    report(counts);
    EXPECT_LT(counts.undecided * 10, counts.points);
}

/// The ray of the corner that two side faces share, camera space, at depth 1.
glm::dvec3 sharedCorner(const ViewFrustum& frustum, Face a, Face b) {
    glm::dvec3 ray(0, 0, 1);
    for (const Face face : {a, b}) {
        const glm::dvec3 normal = outwardNormal(frustum, face);
        if (normal.x != 0) ray.x = std::copysign(tanHalfX(frustum), normal.x);
        if (normal.y != 0) ray.y = std::copysign(tanHalfY(frustum), normal.y);
    }
    return ray;
}

/// The owner of `p` when it is asked for in a rounding mode.
std::size_t ownerIn(int mode, const PartitionSelector& selector, const glm::dvec3& p) {
    const tests::RoundingMode rounding(mode);
    return partitionIndex(selector, p);
}

TEST(Rounding, APointBetweenTwoFacesBelongsToOneOfThem) {
    Random random(7);
    int tested = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const ViewFrustum frustum = randomFrustum(random);
        const glm::dvec3 towardsLight = randomDirection(random);
        const PartitionSelector selector =
            partitionSelector(frustum, towardsLight, {frustum.near, frustum.far}, FaceMaps::Sides);
        for (std::size_t i = 0; i < selector.faces.size(); ++i) {
            if (selector.faces[i].second == glm::dvec3(0)) continue;
            const std::size_t next = (i + 1) % selector.faces.size();
            ASSERT_EQ(selector.faces[next].first, -selector.faces[i].second);
            const glm::dvec3 ray = sharedCorner(frustum, selector.faces[i].face, selector.faces[next].face);
            // From the edge that they share along the light, to the side where the frustum is.
            const bool isInward = glm::dot(outwardNormal(frustum, selector.faces[i].face), towardsLight) < 0;
            const double depth = random.uniform(frustum.near, frustum.far);
            const glm::dvec3 p = ray * depth + towardsLight * ((isInward ? 1 : -1) * depth * random.uniform(0, 1e-3));
            for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
                const std::size_t owner = ownerIn(mode, selector, p);
                EXPECT_TRUE(owner == i || owner == next) << "view " << trial << ", rounding " << mode;
                ++tested;
            }
        }
    }
    EXPECT_GT(tested, 4000);
}

#ifdef __FAST_MATH__
#error "fast math: the compiler may take NaN and infinity for impossible, and sums for associative"
#endif

/// What a compiler cannot know.
template <class Number>
Number opaque(Number value) {
    volatile Number kept = value;
    return kept;
}

template <class Number>
bool keepsSubnormals() {
    const Number tiny = opaque(std::numeric_limits<Number>::min());
    const Number less = opaque(tiny / 2);        // flush to zero would make it 0
    return less > 0 && opaque(less * 2) == tiny; // and so would denormals are zero here
}

TEST(Rounding, NobodyFlushesSubnormalsOrTakesSumsForAssociative) {
    const auto check = [] {
        EXPECT_TRUE(keepsSubnormals<float>());
        EXPECT_TRUE(keepsSubnormals<double>());
        EXPECT_EQ(std::fegetround(), FE_TONEAREST);
        const double huge = opaque(0x1p60);
        EXPECT_EQ(opaque(opaque(1.0) + huge) - huge, 0);
        EXPECT_TRUE(
            opaque(std::numeric_limits<double>::quiet_NaN()) != opaque(std::numeric_limits<double>::quiet_NaN()));
    };
    check();
    std::thread(check).join();
}

} // namespace
} // namespace gnomon::shadow
