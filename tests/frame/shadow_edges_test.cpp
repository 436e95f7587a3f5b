// Edges of shadows: the measure against its twin by loops, and what the default error leaves of them on a statue.
#include "core/random.h"
#include "render/software_backend.h"
#include "tests/frame/shadow_edges.h"
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::tests {
namespace {

/// Whether samples i and j are neighbours on one surface.
bool areBeside(const ReachPicture& picture, std::size_t i, std::size_t j) {
    const std::size_t apart = i > j ? i - j : j - i;
    const bool sameRow = i / picture.width == j / picture.width;
    if (!(apart == 1 && sameRow) && apart != picture.width) return false;
    const ReachSample& a = picture.samples[i];
    const ReachSample& b = picture.samples[j];
    return a.reach != Reach::Nothing && b.reach != Reach::Nothing &&
           std::abs(a.depth - b.depth) < 0.01F * std::min(a.depth, b.depth);
}

/// What `edgeDistances` answers, by loops over all pairs.
std::vector<float> plainEdgeDistances(const ReachPicture& picture, const ReachPicture& other) {
    const std::size_t count = picture.samples.size();
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
            if (areBeside(other, i, j) && other.samples[i].reach != Reach::Lit && other.samples[j].reach == Reach::Lit)
                ends.push_back(i);
    const auto isMet = [](const ReachSample& sample, Reach reach) {
        return sample.reach == reach && sample.sine >= kMinSine;
    };
    std::vector<float> distances(count, -1);
    const std::size_t width = picture.width;
    for (std::size_t i = 0; i < count; ++i) {
        bool isEdge = false;
        for (std::size_t j = 0; j < count; ++j)
            isEdge = isEdge || (areBeside(picture, i, j) && isMet(picture.samples[i], Reach::Dark) &&
                                isMet(picture.samples[j], Reach::Lit));
        if (!isEdge) continue;
        const std::size_t height = count / width;
        double nearest = std::hypot(static_cast<double>(width), static_cast<double>(height));
        for (const std::size_t j : ends) {
            const double across = static_cast<double>(i % width) - static_cast<double>(j % width);
            const std::size_t row = i / width;
            const std::size_t otherRow = j / width;
            const double along = static_cast<double>(row) - static_cast<double>(otherRow);
            nearest = std::min(nearest, std::hypot(across, along));
        }
        distances[i] = static_cast<float>(nearest);
    }
    return distances;
}

ReachPicture randomPicture(Random& random, std::size_t width, std::size_t height) {
    ReachPicture picture{width, std::vector<ReachSample>(width * height)};
    for (ReachSample& sample : picture.samples) {
        sample.reach = random.below(3) == 0 ? Reach::Lit : static_cast<Reach>(random.below(4));
        sample.sine = static_cast<float>(random.uniform(0.1, 0.6));
        sample.depth = random.below(3) == 0 ? 2.0F : 1.0F;
    }
    return picture;
}

TEST(ShadowEdges, AreThoseOfPlainLoops) {
    Random random(19);
    std::size_t edges = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const std::size_t width = 1 + random.below(9);
        const std::size_t height = 1 + random.below(9);
        const ReachPicture a = randomPicture(random, width, height);
        const ReachPicture b = randomPicture(random, width, height);
        const std::vector<float> found = edgeDistances(a, b);
        const std::vector<float> plain = plainEdgeDistances(a, b);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            ASSERT_NEAR(found[i], plain[i], 1e-5) << "trial " << trial << ", sample " << i;
            edges += plain[i] >= 0 ? 1U : 0U;
        }
    }
    EXPECT_GT(edges, 500U);
}

/// A floor in the shadow of a wall up to column `dark`, met by the light at an angle of this sine from there on and at
/// `darkSine` before.
ReachPicture floorWithEdge(std::size_t dark, Reach reach, float darkSine) {
    ReachPicture picture{40, std::vector<ReachSample>(std::size_t{40} * 20)};
    for (std::size_t i = 0; i < picture.samples.size(); ++i) {
        const bool isDark = i % picture.width < dark;
        picture.samples[i] = {isDark ? reach : Reach::Lit, isDark ? darkSine : 0.5F, 1};
    }
    return picture;
}

TEST(ShadowEdges, LieAsFarApartAsTheyWereMoved) {
    const ReachPicture picture = floorWithEdge(20, Reach::Dark, 0.5F);
    for (const std::size_t moved : {0U, 1U, 3U, 7U}) {
        const std::vector<float> distances = edgeDistances(picture, floorWithEdge(20 + moved, Reach::Dark, 0.5F));
        for (std::size_t i = 0; i < distances.size(); ++i)
            EXPECT_EQ(distances[i], i % 40 == 19 ? static_cast<float>(moved) : -1) << i;
    }
}

TEST(ShadowEdges, HaveNotGoneWhereTheOtherSurfaceIsGrazedOrTurned) {
    const ReachPicture picture = floorWithEdge(20, Reach::Dark, 0.5F);
    for (const ReachPicture& other : {floorWithEdge(21, Reach::Dark, 0.1F), floorWithEdge(21, Reach::Turned, 0)}) {
        EXPECT_EQ(edgeDistances(picture, other)[19], 1);
        const std::vector<float> asked = edgeDistances(other, picture);
        EXPECT_EQ(std::count_if(asked.begin(), asked.end(), [](float d) { return d >= 0; }), 0)
            << "nor asked for there";
    }
}

/// The 99th percentile of what is 0 or more.
double percentile99(std::vector<float> distances) {
    distances.erase(std::remove_if(distances.begin(), distances.end(), [](float d) { return d < 0; }), distances.end());
    if (distances.empty()) return -1;
    const auto place = distances.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(distances.size()));
    std::nth_element(distances.begin(), place, distances.end());
    return *place;
}

/// The edges of a statue's shadows at `errorPixels` against those of its finest level, both ways, with the sun beside
/// and behind the camera: the 99th percentile, in pixels.
double statueEdges(double errorPixels) {
    constexpr int kSamples = 4;
    static const BuiltFile statue("statue", 30'000);
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    frame::Renderer renderer(statue.file(), *backend, {});
    const Box& bounds = statue.file().summary().bounds;
    plan::View view;
    view.width = view.height = 160;
    view.camera.target = bounds.center();
    view.camera.eye = bounds.center() + glm::dvec3(0, 0.1, 1.1) * bounds.extent().y;
    std::vector<float> all;
    for (const glm::dvec3& sun : {glm::dvec3(1, 0.8, 0), glm::dvec3(0, 0.8, 1)}) {
        view.towardsLight = sun;
        const DrawnReach full = drawReach(renderer, view, 1e-4, kSamples);
        const DrawnReach cut = drawReach(renderer, view, errorPixels, kSamples);
        for (const std::vector<float>& each :
             {edgeDistances(cut.picture, full.picture), edgeDistances(full.picture, cut.picture)})
            all.insert(all.end(), each.begin(), each.end());
    }
    return percentile99(all) / kSamples;
}

TEST(ShadowEdges, OfAStatueKeepTheirPlaceAtOnePixelOfError) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const double one = statueEdges(1);
    EXPECT_GT(one, 0) << "some moved";
    EXPECT_LE(one, 1.5);
    EXPECT_GT(statueEdges(8), 1.5) << "and what is too coarse is seen";
}

} // namespace
} // namespace gnomon::tests
