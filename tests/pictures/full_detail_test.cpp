// A picture at --error-pixels 1 against the same view at full detail: what a viewer may see of the level of detail.
#include "path/framing.h"
#include "tests/pictures/painted_parts.h"
#include "tests/pictures/painted_wall.h"
#include "tests/pictures/pictured_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace gnomon::tests {
namespace {

constexpr double kFullDetail = 1e-9; // pixels of error: less than any cluster but the finest has

struct Likeness {
    double mean = 0;         // absolute difference over channels and covered pixels, fraction of full scale
    double percentile99 = 0; // of a pixel's largest channel
    double overlap = 0;      // of the silhouettes: intersection over union
};

/// Compares where either picture shows the model.
Likeness likeness(const Drawn& a, const Drawn& b) {
    std::uint64_t sum = 0;
    std::uint64_t inBoth = 0;
    std::vector<int> largest;
    for (std::size_t i = 0; i < a.picture.pixels.size(); ++i) {
        const bool isInA = !std::isinf(a.depth.pixels[i]);
        const bool isInB = !std::isinf(b.depth.pixels[i]);
        if (!isInA && !isInB) continue;
        inBoth += isInA && isInB ? 1U : 0U;
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = std::abs(int{a.picture.pixels[i][c]} - int{b.picture.pixels[i][c]});
            sum += static_cast<std::uint64_t>(apart);
            worst = std::max(worst, apart);
        }
        largest.push_back(worst);
    }
    if (largest.empty()) return {0, 0, 1}; // two pictures of nothing
    const auto covered = static_cast<double>(largest.size());
    const auto place = largest.begin() + static_cast<std::ptrdiff_t>(covered * 0.99);
    std::nth_element(largest.begin(), place, largest.end());
    return {static_cast<double>(sum) / (covered * 3 * 255), *place / 255.0, static_cast<double>(inBoth) / covered};
}

/// The bar for any model.
constexpr Likeness kBar{0.01, 0.1, 0.995};

/// `view` turned by a quarter of a pixel to the right and up: its pixels are sampled where a picture of twice the
/// resolution has one of its four samples.
plan::View turnedByQuarterPixel(plan::View view) {
    const CameraBasis basis = cameraBasis(view.camera);
    const double pixel = 2 * view.tanHalfY() / view.height * glm::length(view.camera.target - view.camera.eye);
    view.camera.target += (basis.right + basis.up) * (0.25 * pixel);
    return view;
}

/// Models whose parts and relief are finer than the pixels that see them, so that a picture with one sample a pixel is
/// partly chance. Of their pictures at full detail no two are alike by the bar that differ in nothing but where in a
/// pixel its sample lies; those at an error of a pixel have to be as alike as these are, unless they keep the bar.
bool isFinerThanPixels(const std::string& name) {
    static const std::set<std::string> names = {"statue", "plant", "lego_isd10030", "terrain_srtm_N44W072"};
    return names.contains(name);
}

/// Models whose detail is their paint: its bar is lower, for nothing else differs.
bool isPainted(const std::string& name) {
    static const std::set<std::string> names = {"painted_wall", "scan_legionofhonor_color", "terrain_srtm_N44W072"};
    return names.contains(name);
}

/// Draws three views of `model` both ways; a pair that differs too much stays on disk.
void expectLikeFullDetail(const std::string& model, const std::string& name, int side) {
    PicturedModel pictured(model, Backend::Software);
    int number = 0;
    for (const plan::View& view : threeViews(pictured.file(), side)) {
        const std::string place = testing::TempDir() + "gnomon_" + name + "_view" + std::to_string(++number);
        const Drawn full = pictured.draw(view, kFullDetail);
        const Drawn coarse = pictured.draw(view, 1);
        const Likeness found = likeness(full, coarse);
        const Likeness chance = likeness(full, pictured.draw(turnedByQuarterPixel(view), kFullDetail));
        std::printf(
            "%s, view %d: mean %.4f, 99th percentile %.3f, overlap %.4f; full detail a quarter pixel aside: %.4f, "
            "%.3f, "
            "%.4f\n",
            name.c_str(),
            number,
            found.mean,
            found.percentile99,
            found.overlap,
            chance.mean,
            chance.percentile99,
            chance.overlap);
        Likeness bar = kBar;
        if (isPainted(name)) bar.percentile99 = 0.08;
        if (isFinerThanPixels(name)) {
            bar.mean = std::max(bar.mean, 1.05 * chance.mean); // chance, too, is measured in one way of many
            bar.percentile99 = std::max(bar.percentile99, chance.percentile99);
        }
        EXPECT_LT(found.mean, bar.mean) << place;
        EXPECT_LT(found.percentile99, bar.percentile99) << place;
        EXPECT_GE(found.overlap, bar.overlap) << place;
        if (!testing::Test::HasFailure()) continue;
        render::writePng(place + "_full.png", full.picture);
        render::writePng(place + "_coarse.png", coarse.picture);
    }
}

struct Made {
    const char* kind;
    std::uint64_t triangles;
    int side;
};

void expectMadeLikeFullDetail(const Made& made) {
    const ScratchFile mesh("mesh.ply");
    const ScratchFile model("model.gnm");
    writeMade(made.kind, made.triangles, mesh.path());
    build(mesh.path(), model.path());
    expectLikeFullDetail(model.path(), made.kind, made.side);
}

void expectWallLikeFullDetail(std::uint32_t squares, int side) {
    const ScratchFile mesh("mesh.ply");
    const ScratchFile model("model.gnm");
    writePaintedWall(squares, mesh.path());
    build(mesh.path(), model.path());
    expectLikeFullDetail(model.path(), "painted_wall", side);
}

TEST(PaintedWall, LooksTheSameAtOnePixel) {
    expectWallLikeFullDetail(150, 200);
}

TEST(SlowPaintedWall, Of600SquaresLooksTheSameAtOnePixel) {
    expectWallLikeFullDetail(600, 800);
}

/// Differences over a whole picture.
struct PictureDifference {
    double mean = 0; // over channels, fraction of full scale
    double off = 0;  // share of the pixels with a channel that differs by more than a quarter
};

PictureDifference pictureDifference(const render::Picture& a, const render::Picture& b) {
    std::uint64_t sum = 0;
    std::uint64_t off = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]});
            sum += static_cast<std::uint64_t>(apart);
            largest = std::max(largest, apart);
        }
        if (largest * 4 > 255) ++off;
    }
    const auto pixels = static_cast<double>(a.pixels.size());
    return {static_cast<double>(sum) / (pixels * 3 * 255), static_cast<double>(off) / pixels};
}

/// A model in which z is up, from the front, as `render` frames it.
plan::View framedView(const Box& bounds, int width, int height) {
    std::vector<glm::dvec3> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners.emplace_back(
            (i & 1U) != 0 ? bounds.max.x : bounds.min.x,
            (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
            (i & 4U) != 0 ? bounds.max.z : bounds.min.z);
    plan::View view;
    view.width = width;
    view.height = height;
    const path::Vantage vantage = path::vantageOf({}, {0, 0, 1});
    view.camera = path::framingCamera(corners, vantage, view.aspect(), view.camera.fovYRadians);
    return view;
}

/// The bar for models of coloured parts.
void expectPartsLikeFullDetail(const PaintedMesh& painted) {
    const ScratchFile mesh("mesh.ply");
    const ScratchFile model("model.gnm");
    writePainted(painted, mesh.path());
    build(mesh.path(), model.path());
    PicturedModel pictured(model.path(), Backend::Software);
    for (const auto& [width, height] : {std::pair{400, 400}, {1280, 720}}) {
        const plan::View view = framedView(pictured.file().summary().bounds, width, height);
        const PictureDifference found =
            pictureDifference(pictured.draw(view, kFullDetail).picture, pictured.draw(view, 1).picture);
        std::printf("%d pixels wide: mean %.5f, off %.5f\n", width, found.mean, found.off);
        EXPECT_LE(found.mean, 0.005) << width;
        EXPECT_LE(found.off, 0.002) << width;
    }
}

constexpr double kWholeFaces = 1000; // of painted parts: faces are not cut into cells

TEST(PaintedParts, ACityLooksTheSameAtOnePixel) {
    expectPartsLikeFullDetail(paintedCity(8, kWholeFaces));
}

TEST(PaintedParts, ABridgeLooksTheSameAtOnePixel) {
    expectPartsLikeFullDetail(paintedBridge(4, kWholeFaces));
}

TEST(SlowPaintedParts, LookTheSameAtOnePixel) {
    for (const double cell : {kWholeFaces, 1.0})
        for (const PaintedMesh& mesh : {paintedCity(12, cell), paintedBridge(20, cell)}) {
            expectPartsLikeFullDetail(mesh);
            expectPartsLikeFullDetail(welded(mesh));
        }
}

class FullDetail : public testing::TestWithParam<Made> {};

TEST_P(FullDetail, LooksTheSameAtOnePixel) {
    expectMadeLikeFullDetail(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Made,
    FullDetail,
    testing::Values(Made{"statue", 100'000, 200}, Made{"plant", 100'000, 400}, Made{"planes", 100'000, 200}),
    [](const auto& made) { return made.param.kind; });

class SlowFullDetail : public testing::TestWithParam<const char*> {};

TEST_P(SlowFullDetail, OfAMillionLooksTheSameAtOnePixel) {
    expectMadeLikeFullDetail({GetParam(), 1'000'000, 800});
}

INSTANTIATE_TEST_SUITE_P(Made, SlowFullDetail, testing::Values("statue", "plant", "planes"), [](const auto& kind) {
    return kind.param;
});

class SlowFullDetailOfReal : public testing::TestWithParam<const char*> {};

TEST_P(SlowFullDetailOfReal, LooksTheSameAtOnePixel) {
    const char* folder = std::getenv("GNOMON_MODELS");
    if (folder == nullptr) GTEST_SKIP() << "no real models: GNOMON_MODELS is not set";
    const std::string packed = std::string(folder) + "/" + GetParam() + ".ply";
    const ScratchFile mesh("mesh.ply");
    if (std::filesystem::exists(packed))
        std::filesystem::copy_file(packed, mesh.path(), std::filesystem::copy_options::overwrite_existing);
    else
        ASSERT_EQ(std::system(("xz -dc '" + packed + ".xz' > '" + mesh.path() + "'").c_str()), 0);
    const ScratchFile model("model.gnm");
    build(mesh.path(), model.path());
    expectLikeFullDetail(model.path(), GetParam(), 800);
}

INSTANTIATE_TEST_SUITE_P(
    Real,
    SlowFullDetailOfReal,
    testing::Values(
        "bim_clinic",
        "bunny_10scans",
        "dragon_100k",
        "igea_tristrips",
        "lego_isd10030",
        "scan_legionofhonor_color",
        "terrain_srtm_N44W072"),
    [](const auto& name) { return name.param; });

} // namespace
} // namespace gnomon::tests
