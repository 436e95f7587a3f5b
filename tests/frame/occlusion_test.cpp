// Frames drawn without what is hidden, against the same frames with all of it: to the last bit, whatever the view.
#include "core/random.h"
#include "tests/support/drawn_model.h"
#include "tests/support/made_model.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstring>

namespace gnomon::frame {
namespace {

using plan::Choice;
using plan::ShadowMode;

/// All that a frame leaves to be looked at.
struct Drawn {
    render::Picture picture;
    render::FloatPicture depth;
    render::Raster<render::SurfaceSample> surfaces;
    telemetry::FrameRow row;
};

template <class Pixel>
bool sameBits(const std::vector<Pixel>& a, const std::vector<Pixel>& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Pixel)) == 0; // null where there is none
}

/// A renderer of a model over the software backend.
class Stage {
public:
    explicit Stage(const hierarchy::ModelFile& file) : file_(&file), renderer_(file, *backend_, ResidencyOptions()) {}

    Drawn draw(const plan::View& view, const plan::Quality& quality, int threads, bool wantsSurfaces) {
        FrameOptions options;
        options.wantsSurfaces = wantsSurfaces;
        Drawn drawn;
        tbb::task_arena(threads).execute([&] { drawn.row = renderer_.render(view, quality, options).row; });
        drawn.picture = backend_->picture();
        drawn.depth = backend_->viewDepth();
        if (wantsSurfaces) drawn.surfaces = backend_->surfaces();
        return drawn;
    }

    const Box& bounds() const { return file_->summary().bounds; }

private:
    const hierarchy::ModelFile* file_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    Renderer renderer_;
};

glm::dvec3 pointIn(const Box& box, Random& random) {
    return box.min + box.extent() * glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
}

/// From amid a model or around it, with any angle, of any size up to `maxPixels` a side.
plan::View randomView(const Box& bounds, Random& random, int maxPixels) {
    plan::View view;
    view.width = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(maxPixels)));
    view.height = 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(maxPixels)));
    if (random.below(8) == 0) view.width = 1;
    if (random.below(8) == 0) view.height = 1;
    view.camera.target = pointIn(bounds, random);
    view.camera.eye = pointIn(bounds, random);
    if (random.below(3) == 0) // outside
        view.camera.eye += (view.camera.eye - bounds.center()) * random.uniform(0, 4);
    view.camera.fovYRadians = random.uniform(0.3, 2.3);
    return view;
}

/// Draws `count` views both ways, for 1, 2 or 16 threads; how many clusters were hidden in all.
std::int64_t expectSameFrames(const hierarchy::ModelFile& file, std::uint64_t seed, int count, int maxPixels) {
    const tbb::global_control sixteen(tbb::global_control::max_allowed_parallelism, 16);
    Stage stage(file);
    Random random(seed);
    std::int64_t hidden = 0;
    for (int i = 0; i < count; ++i) {
        SCOPED_TRACE(std::to_string(seed) + ", view " + std::to_string(i));
        const plan::View view = randomView(stage.bounds(), random, i % 100 == 99 ? 4000 : maxPixels);
        plan::Quality quality;
        constexpr std::array kModes = {ShadowMode::Off, ShadowMode::Off, ShadowMode::Exact, ShadowMode::Maps};
        quality.shadows = kModes[static_cast<std::size_t>(i) % kModes.size()];
        quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
        quality.errorPixels = random.uniform(0.3, 2);
        quality.occlusion = Choice::Off;
        const Drawn all = stage.draw(view, quality, 2, i % 5 == 0);
        EXPECT_EQ(all.row.occlusion, "off");
        EXPECT_FALSE(all.row.clustersHidden.has_value());
        quality.occlusion = Choice::On;
        std::optional<std::int64_t> counted;
        for (const int threads : i % 10 == 0 ? std::vector<int>{1, 2, 16} : std::vector<int>{i % 2 == 0 ? 16 : 1}) {
            const Drawn seen = stage.draw(view, quality, threads, i % 5 == 0);
            EXPECT_TRUE(sameBits(seen.picture.pixels, all.picture.pixels));
            EXPECT_TRUE(sameBits(seen.depth.pixels, all.depth.pixels));
            EXPECT_TRUE(sameBits(seen.surfaces.pixels, all.surfaces.pixels));
            EXPECT_EQ(seen.row.occlusion, "on");
            EXPECT_EQ(seen.row.clustersHidden.value_or(-1), counted.value_or(seen.row.clustersHidden.value_or(-2)));
            counted = seen.row.clustersHidden;
        }
        hidden += counted.value_or(0);
        if (::testing::Test::HasFailure()) break;
    }
    return hidden;
}

TEST(OcclusionFrames, AreThoseWithAllThatIsHidden) {
    const tests::BuiltFile plant("plant", 20'000);
    EXPECT_GT(expectSameFrames(plant.file(), 1, 40, 300), 25);
}

TEST(SlowOcclusionFrames, AreThoseWithAllThatIsHiddenInAThousandViewsOfFiveModels) {
    const tests::BuiltFile plant("plant", 60'000);
    const tests::BuiltFile largePlant("plant", 300'000);
    const tests::BuiltFile statue("statue", 40'000);
    const tests::BuiltFile largeStatue("statue", 200'000);
    const tests::BuiltFile planes("planes", 270'000);
    std::uint64_t seed = 10;
    for (const tests::BuiltFile* built : {&plant, &largePlant, &statue, &largeStatue, &planes})
        EXPECT_GT(expectSameFrames(built->file(), seed++, 200, 500), 1000);
}

TEST(OcclusionFrames, AutoDrawsAllWhereLittleLiesBehindOneAnother) {
    const tests::BuiltFile plant("plant", 20'000);
    Stage stage(plant.file());
    plan::View view;
    view.width = view.height = 200;
    view.camera.target = stage.bounds().center();
    view.camera.eye = view.camera.target + glm::dvec3(0, 5, 8) * glm::length(stage.bounds().extent());
    plan::Quality quality;
    quality.shadows = ShadowMode::Off;
    EXPECT_EQ(stage.draw(view, quality, 2, false).row.occlusion, "off"); // a few pixels of it
    view.camera.eye = stage.bounds().min + stage.bounds().extent() * glm::dvec3(0.1, 0.2, 0.5);
    EXPECT_EQ(stage.draw(view, quality, 2, false).row.occlusion, "on");
}

} // namespace
} // namespace gnomon::frame
