// The bounds of one collapse after the other: they hold for points strewn on the star, and are not much more than they
// need be.
#include "preprocess/simplify/collapse_error_bound.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace gnomon::simplify {
namespace {

constexpr double kAnyBound = std::numeric_limits<double>::infinity();

std::vector<TriangleError> someErrors(std::size_t count) {
    Random random(3);
    std::vector<TriangleError> errors(count);
    for (TriangleError& error : errors)
        error = {static_cast<float>(random.uniform(0, 4)), static_cast<float>(random.uniform(0, 4))};
    return errors;
}

Patch patchWith(const read::CodeMesh& mesh, std::span<const TriangleError> errors, bool isErrorBounded) {
    Patch patch = patchOf(mesh);
    patch.errors = errors;
    patch.isErrorBounded = isErrorBounded;
    return patch;
}

/// A patch with errors of its own, and the objects that a collapse needs.
struct Bench {
    explicit Bench(const read::CodeMesh& source, bool isErrorBounded = true)
        : given(someErrors(source.triangles.size())), patch(patchWith(source, given, isErrorBounded)) {}

    std::vector<TriangleError> given;
    Patch patch;
    SimplificationMesh mesh{patch};
    CollapseErrorBound errors{patch, mesh};
    CollapseStar star{patch, mesh};
};

/// The triangles of the star after its collapse, those that stay and the receivers. Vertices have the numbers of their
/// positions.
std::map<std::uint32_t, Triangle> trianglesAfter(Bench& bench) {
    std::map<std::uint32_t, Triangle> after;
    const auto moved = [&](std::uint32_t t) {
        Triangle p = bench.mesh.positions(t);
        std::replace(p.begin(), p.end(), bench.star.from(), bench.star.to());
        return p;
    };
    for (const CollapseErrorBound::Outcome& outcome : bench.errors.outcomes())
        after[outcome.triangle] = moved(outcome.triangle);
    return after;
}

/// Each point of the star before has an outcome that holds it, and the other way round.
void expectHeld(Bench& bench, Random& random) {
    const std::map<std::uint32_t, Triangle> after = trianglesAfter(bench);
    for (const StarFace& face : bench.star.faces())
        for (int sample = 0; sample < 5; ++sample) {
            const glm::dvec3 p = randomPoint(bench.patch, bench.mesh.vertices(face.triangle), random);
            const double before = bench.errors.of(face.triangle).fromSource;
            bool isHeld = false;
            for (const CollapseErrorBound::Outcome& outcome : bench.errors.outcomes())
                isHeld = isHeld || distanceTo(bench.patch, p, after.at(outcome.triangle)) + before <=
                                       outcome.fromSource * (1 + 1e-6) + 1e-9;
            ASSERT_TRUE(isHeld);
        }
}

/// Moves `bench` one collapse on, if there is one from `p` that may be; whether there is.
bool evaluateFrom(Bench& bench, std::uint32_t p) {
    if (bench.patch.isLocked[p] != 0 || !bench.mesh.isRepresentative(p) || !bench.mesh.hasTriangles(p)) return false;
    const auto found = bench.mesh.neighbours(p);
    const std::vector<std::uint32_t> neighbours(found.begin(), found.end());
    for (const std::uint32_t q : neighbours) {
        bench.star.gather(p, q);
        if (bench.star.vanishingCount() >= bench.mesh.triangleCount()) continue;
        if (bench.star.turnsFace() || bench.star.breaksLockedEdge()) continue;
        if (bench.errors.evaluate(bench.star, kAnyBound)) return true;
    }
    return false;
}

void carryOut(Bench& bench) {
    bench.errors.commit(bench.star);
    bench.star.apply();
    bench.mesh.merge(bench.star.from(), bench.star.to());
}

double largestBefore(Bench& bench) {
    double largest = 0;
    for (const StarFace& face : bench.star.faces()) {
        const TriangleError error = bench.errors.of(face.triangle);
        largest = std::max({largest, double{error.fromSource}, double{error.toSource}});
    }
    return largest;
}

/// Collapses at random and calls `check()` before each is carried out; how many there were.
template <class Check>
int collapseMany(Bench& bench, Random& random, Check check) {
    int collapses = 0;
    for (int run = 0; run < 400; ++run) {
        if (!evaluateFrom(bench, static_cast<std::uint32_t>(random.below(bench.patch.positions.size())))) continue;
        check();
        if (testing::Test::HasFatalFailure()) break;
        carryOut(bench);
        ++collapses;
    }
    return collapses;
}

TEST(CollapseErrorBound, HoldsWhateverVanishes) {
    Bench bench(mixedMesh());
    Random random(5);
    EXPECT_GT(collapseMany(bench, random, [&] { expectHeld(bench, random); }), 60);
}

TEST(CollapseErrorBound, OnASheetHoldsAndIsNoMoreThanIfEveryPointMovedAsFarAsTheVertex) {
    Bench bench(read::bumpySheet(12));
    Random random(5);
    const int collapses = collapseMany(bench, random, [&] {
        const double way =
            glm::distance(bench.patch.positions[bench.star.from()], bench.patch.positions[bench.star.to()]);
        ASSERT_LE(bench.errors.worst(), (largestBefore(bench) + way) * (1 + 1e-6));
        expectHeld(bench, random);
    });
    EXPECT_GT(collapses, 60);
}

TEST(CollapseErrorBound, OnAPlaneIsWhatWasThereBefore) {
    read::CodeMesh flat = read::bumpySheet(8);
    for (glm::dvec3& p : flat.positions)
        p.y = 0;
    Bench bench(flat);
    int collapses = 0;
    for (std::uint32_t p = 0; p < bench.patch.positions.size(); ++p) {
        if (bench.mesh.isBorder(p) || !evaluateFrom(bench, p)) continue;
        ASSERT_LE(bench.errors.worst(), largestBefore(bench) + 1e-9);
        carryOut(bench);
        ++collapses;
    }
    EXPECT_GT(collapses, 20);
}

TEST(CollapseErrorBound, StoresTheOutcomesAndNothingElse) {
    Bench bench(read::bumpySheet(10));
    Random random(6);
    for (int run = 0; run < 100; ++run) {
        const auto p = static_cast<std::uint32_t>(random.below(bench.patch.positions.size()));
        if (!evaluateFrom(bench, p)) continue;
        std::vector<TriangleError> expected;
        for (std::uint32_t t = 0; t < bench.patch.triangles.size(); ++t)
            expected.push_back(bench.errors.of(t));
        for (const StarFace& face : bench.star.faces())
            if (!bench.star.vanishes(face)) expected[face.triangle] = {};
        for (const CollapseErrorBound::Outcome& outcome : bench.errors.outcomes()) {
            TriangleError& error = expected[outcome.triangle];
            error.fromSource = std::max(error.fromSource, roundedUp(outcome.fromSource));
            error.toSource = std::max(error.toSource, roundedUp(outcome.toSource));
        }
        carryOut(bench);
        for (std::uint32_t t = 0; t < bench.patch.triangles.size(); ++t) {
            ASSERT_EQ(bench.errors.of(t).fromSource, expected[t].fromSource);
            ASSERT_EQ(bench.errors.of(t).toSource, expected[t].toSource);
        }
        double around = 0;
        bench.mesh.forEachCorner(bench.star.to(), [&](std::uint32_t corner) {
            around = std::max({around, double{expected[corner / 3].fromSource}, double{expected[corner / 3].toSource}});
        });
        ASSERT_NEAR(bench.errors.largestAround(bench.star.to()), around, around * 1e-6);
    }
}

TEST(CollapseErrorBound, GivesUpOnlyWhereABoundReachesTheLimit) {
    Bench bench(mixedMesh());
    int givenUp = 0;
    for (std::uint32_t p = 0; p < bench.patch.positions.size(); ++p) {
        if (!evaluateFrom(bench, p)) continue;
        const double worst = bench.errors.worst();
        EXPECT_TRUE(bench.errors.evaluate(bench.star, worst * 1.01));
        EXPECT_EQ(bench.errors.worst(), worst);
        if (!bench.errors.evaluate(bench.star, worst * 0.01)) {
            ++givenUp;
            EXPECT_GE(bench.errors.worst(), worst * 0.01);
        }
    }
    EXPECT_GT(givenUp, 0);
}

TEST(CollapseErrorBound, OfTwoTrianglesInOnePlaceOneCarriesWhatWasMappedToBoth) {
    Bench bench(read::bumpySheet(3));
    bench.errors.merge({1, 4});
    EXPECT_EQ(bench.errors.of(1).fromSource, std::max(bench.given[1].fromSource, bench.given[4].fromSource));
    EXPECT_EQ(bench.errors.of(1).toSource, std::min(bench.given[1].toSource, bench.given[4].toSource));
    EXPECT_EQ(bench.errors.of(2).toSource, bench.given[2].toSource);
}

TEST(CollapseErrorBound, IsNothingWhereNobodyAsks) {
    Bench bench(read::bumpySheet(3), false);
    for (std::uint32_t p = 0; p < bench.patch.positions.size(); ++p)
        EXPECT_EQ(bench.errors.largestAround(p), 0);
}

} // namespace
} // namespace gnomon::simplify
