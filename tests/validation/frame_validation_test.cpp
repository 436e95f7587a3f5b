// What is drawn for a frame and for its proofs, counted: a frame draws once, and a proof what it says.
#include "core/random.h"
#include "render/software_backend.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include <unistd.h>

namespace gnomon::validation {
namespace {

/// The software backend, with where the eye of each image is.
class CountingBackend final : public render::Backend {
public:
    std::string name() const override { return inner_->name(); }

    render::PassStatistics drawShadowMaps(const render::DrawInputs& frame) override {
        return inner_->drawShadowMaps(frame);
    }

    render::PassStatistics drawImage(const render::DrawInputs& frame) override {
        images_.push_back(frame.plan->view.camera.eye.x);
        return inner_->drawImage(frame);
    }

    Bytes deviceMemory() const override { return inner_->deviceMemory(); }

    render::Picture picture() override { return inner_->picture(); }

    render::LightPicture light() override { return inner_->light(); }

    std::optional<std::uint64_t> litPixels() override { return inner_->litPixels(); }

    render::FloatPicture viewDepth() override { return inner_->viewDepth(); }

    render::FloatPicture shadowDepth() override { return inner_->shadowDepth(); }

    render::Raster<render::SurfaceSample> surfaces() override { return inner_->surfaces(); }

    /// Where the eyes of the images drawn since the last call are, along x.
    std::vector<double> takeImages() { return std::exchange(images_, {}); }

private:
    std::unique_ptr<render::Backend> inner_ = render::makeSoftwareBackend();
    std::vector<double> images_;
};

/// A corner of a box, of coordinates that the model keeps.
glm::dvec3 inSixtyFourths(Random& random) {
    const auto one = [&] { return (static_cast<double>(random.below(257)) - 128) / 64; };
    const double x = one();
    const double y = one();
    return {x, y, one()};
}

/// A crate on the ground in a file of its own.
class CrateFile {
public:
    CrateFile() { tests::writeModel(frame::crateOnGround().model(), path_); }

    ~CrateFile() { std::filesystem::remove(path_); }

    CrateFile(const CrateFile&) = delete;
    CrateFile& operator=(const CrateFile&) = delete;
    CrateFile(CrateFile&&) = delete;
    CrateFile& operator=(CrateFile&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_ =
        (std::filesystem::temp_directory_path() / ("gnomon_proven_" + std::to_string(::getpid()) + ".gnm")).string();
};

class FrameValidations : public testing::Test {
protected:
    frame::Frame render(double x) {
        plan::View view = frame::overGround();
        view.width = view.height = 48;
        view.camera.eye.x = x;
        frame::Frame frame = renderer.render(view, frame::inSlices(1), {}, history);
        history = frame.history;
        return frame;
    }

    CrateFile crate;
    hierarchy::ModelFile file{crate.path()};
    CountingBackend counter;
    frame::Renderer renderer{file, counter, {}};
    frame::History history;
};

TEST_F(FrameValidations, AFrameIsDrawnOnceAndMeasuredNowhere) {
    const frame::Frame frame = render(1);
    ASSERT_FALSE(frame.plan.passes.empty());
    EXPECT_EQ(counter.takeImages(), (std::vector<double>{1}));
    EXPECT_FALSE(frame.row.measuredAliasing);
    EXPECT_FALSE(frame.row.wrongShadowFraction);
    EXPECT_FALSE(frame.row.imageDifference);
    EXPECT_FALSE(frame.row.crawl);
}

// The light lies in the plane of what is seen, so that integers alone can say which side of it faces the light: floats
// say either, and a picture's pixels are to be those of the integers.
TEST(WrongPixels, AreNoneOfWhatTheLightGrazes) {
    Random random(149);
    std::size_t grazed = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 first = inSixtyFourths(random);
        const glm::dvec3 second = inSixtyFourths(random);
        plan::View view;
        view.towardsLight = inSixtyFourths(random).x * first + inSixtyFourths(random).x * second;
        if (glm::length(glm::cross(first, second)) < 0.1 || glm::length(view.towardsLight) < 0.1) continue;
        tests::SceneMesh scene;
        scene.addQuad({0, 0, 0}, first, second);
        frame::DrawnModel model(scene.model());
        const glm::dvec3 middle = 0.5 * (first + second);
        view.camera = {middle + 4.0 * glm::normalize(glm::cross(first, second)), middle, {0.6, 0.8, 0.1}, 1};
        view.width = view.height = 32;
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Exact;
        const frame::Frame frame = model.draw(view, quality);
        ++grazed;
        ValidationOptions options;
        options.groundTruth = GroundTruth::Exact;
        EXPECT_EQ(validate(model.renderer(), frame, options).wrongPixelsAll, 0) << i;
    }
    EXPECT_GT(grazed, 30U);
}

TEST_F(FrameValidations, NothingIsDrawnToFindNothingOut) {
    const frame::Frame frame = render(1);
    counter.takeImages();
    const FrameValidation proof = validate(renderer, frame, {});
    EXPECT_TRUE(counter.takeImages().empty());
    EXPECT_FALSE(proof.aliasing || proof.truth || proof.crawl || proof.imageDifference);
}

TEST_F(FrameValidations, TheFirstFrameHasNothingToCrawlFrom) {
    const frame::Frame frame = render(1);
    counter.takeImages();
    ValidationOptions options;
    options.measuresCrawl = true;
    EXPECT_FALSE(validate(renderer, frame, options).crawl);
    EXPECT_TRUE(counter.takeImages().empty());
}

TEST_F(FrameValidations, EveryImageOfAProofIsOneThatItNames) {
    render(1);
    const frame::Frame frame = render(1.25);
    const render::Picture picture = counter.picture();
    counter.takeImages();
    ValidationOptions options;
    options.measuresAliasing = options.measuresCrawl = options.comparesWithFinest = true;
    options.groundTruth = GroundTruth::SameDetail;
    const FrameValidation proof = validate(renderer, frame, options);
    // With its surfaces; the finest level's surfaces and its image by rays; the frame before; as it was.
    EXPECT_EQ(counter.takeImages(), (std::vector<double>{1.25, 1.25, 1.25, 1, 1.25}));
    EXPECT_EQ(counter.picture().pixels, picture.pixels);
    EXPECT_TRUE(proof.aliasing && proof.truth && proof.crawl && proof.imageDifference);
    telemetry::FrameRow row = frame.row;
    setAccuracy(proof, row);
    EXPECT_EQ(row.measuredAliasing, proof.aliasing->worst());
    EXPECT_EQ(row.wrongShadowFraction, proof.truth->answerable.wrongFraction);
    EXPECT_EQ(row.imageDifference, proof.imageDifference);
    EXPECT_EQ(row.crawl, proof.crawl->share());
    setAccuracy({}, row);
    EXPECT_FALSE(row.measuredAliasing || row.wrongShadowFraction || row.imageDifference || row.crawl);
}

TEST_F(FrameValidations, TheFramesToComeDoNotDependOnIt) {
    render(1);
    ValidationOptions options;
    options.measuresAliasing = options.measuresCrawl = options.comparesWithFinest = true;
    validate(renderer, render(1.25), options);
    const frame::Frame after = render(1.5);
    frame::Renderer plain(file, counter, {});
    frame::History plainHistory;
    for (const double x : {1.0, 1.25}) {
        plan::View view = after.plan.view;
        view.camera.eye.x = x;
        plainHistory = plain.render(view, after.plan.quality, {}, plainHistory).history;
    }
    const frame::Frame expected = plain.render(after.plan.view, after.plan.quality, {}, plainHistory);
    EXPECT_EQ(after.plan.near, expected.plan.near);
    EXPECT_EQ(after.plan.far, expected.plan.far);
    EXPECT_EQ(after.plan.passes.size(), expected.plan.passes.size());
}

} // namespace
} // namespace gnomon::validation
