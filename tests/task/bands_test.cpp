// A picture that is drawn in bands has the bytes of the whole one, and takes no more memory than it may.
#include "frame/picture_memory.h"
#include "settings/resolve.h"
#include "task/finished_picture.h"
#include "tests/support/crate_scene.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace gnomon::task {
namespace {

using plan::ShadowMode;

/// The file of a crate on a plain, gone with this.
class CrateFile {
public:
    CrateFile() : path_(testing::TempDir() + "gnomon_bands_" + std::to_string(::getpid()) + ".gnm") {
        tests::writeModel(frame::crateOnGround().model(), path_);
    }

    ~CrateFile() { std::filesystem::remove(path_); }

    CrateFile(const CrateFile&) = delete;
    CrateFile& operator=(const CrateFile&) = delete;
    CrateFile(CrateFile&&) = delete;
    CrateFile& operator=(CrateFile&&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

TEST(Bands, CoverAPictureInWholeStripes) {
    plan::View view;
    view.width = 7680;
    view.height = 4320;
    plan::Quality quality;
    quality.shadows = ShadowMode::Auto;
    frame::FrameOptions options;
    options.isAccumulated = true;
    const Bytes whole = frame::pictureBytes(view, quality, options);
    EXPECT_EQ(frame::bandsOf(view, quality, options, {2 * whole.count}).size(), 1U);
    const Bytes memory = mebibytes(448);
    const std::vector<render::ImageRows> bands = frame::bandsOf(view, quality, options, memory);
    ASSERT_GT(bands.size(), 8U);
    int next = 0;
    for (const render::ImageRows& band : bands) {
        EXPECT_EQ(band.first, next);
        EXPECT_EQ(band.first % 64, 0);
        next += band.count;
        options.rows = band;
        EXPECT_LT(
            frame::pictureBytes(view, quality, options).count,
            memory.count / 4 + std::uint64_t{5} * 7680 * 4320 + mebibytes(32).count);
    }
    EXPECT_EQ(next, view.height);
}

struct Variant {
    ShadowMode mode = ShadowMode::Exact;
    int samples = 1;
    bool hasExtras = false; // a ground, a sky, penumbrae and a transparent background
};

std::vector<Variant> variants() {
    std::vector<Variant> all;
    for (const ShadowMode mode : {ShadowMode::Exact, ShadowMode::Maps, ShadowMode::Rays, ShadowMode::Off}) {
        all.push_back({mode, 1, false});
        all.push_back({mode, 2, false});
        all.push_back({mode, 2, true});
    }
    return all;
}

plan::Quality qualityOf(const Variant& variant) {
    plan::Quality quality;
    quality.shadows = variant.mode;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    if (!variant.hasExtras) {
        quality.look.shading = plan::Shading::Auto;
        return quality;
    }
    quality.look.shading = plan::Shading::Lit;
    quality.look.ground = true;
    quality.look.background.kind = plan::Background::Kind::Transparent;
    quality.sky.directions = 2;
    return quality;
}

/// Expects that both sessions draw the same picture.
void expectSamePicture(Session& wide, Session& narrow, const plan::View& view, const Variant& variant) {
    SCOPED_TRACE(std::to_string(static_cast<int>(variant.mode)) + " " + std::to_string(variant.samples));
    NoProgress progress;
    const plan::Quality quality = qualityOf(variant);
    const FinishedPicture whole = drawFinished(wide, {view, quality, {}, variant.samples}, progress);
    const FinishedPicture bands = drawFinished(narrow, {view, quality, {}, variant.samples}, progress);
    EXPECT_TRUE(whole.picture.pixels == bands.picture.pixels);
    ASSERT_EQ(whole.coverage.has_value(), bands.coverage.has_value());
    if (whole.coverage) {
        EXPECT_TRUE(whole.coverage->pixels == bands.coverage->pixels);
    }
}

/// The same picture by a session that has much memory and by one that has little.
TEST(Bands, HaveTheBytesOfTheWholePicture) {
    settings::Settings much;
    much.backend = settings::Backend::Software;
    settings::Settings little = much;
    little.memory = mebibytes(84); // 20 for pictures and pages
    const auto ignore = [](const std::string&) {};
    const CrateFile crate;
    Session wide(crate.path(), much, ignore);
    Session narrow(crate.path(), little, ignore);
    plan::View view = settings::viewOf(much, wide.model());
    view.width = 300;
    view.height = 450;
    int banded = 0;
    for (const Variant& variant : variants()) {
        view.sunAngleRadians = variant.hasExtras ? 0.05 : 0;
        frame::FrameOptions options;
        options.isAccumulated = variant.samples > 1;
        const Bytes memory = narrow.renderer().residency().memory();
        banded += frame::bandsOf(view, qualityOf(variant), options, memory).size() > 1 ? 1 : 0;
        expectSamePicture(wide, narrow, view, variant);
    }
    EXPECT_GT(banded, 6) << "this tests nothing";
}

} // namespace
} // namespace gnomon::task
