// Shadow classes of hand-made pixels: each status and each kind of surface.
#include "render/exact_pass.h"
#include "validation/shadow_classes.h"

#include <gtest/gtest.h>

namespace gnomon::validation {
namespace {

using render::SurfaceSample;

SurfaceSample surface(float partitionAndLit) {
    SurfaceSample sample;
    sample.isSurface = 1;
    sample.partitionAndLit = partitionAndLit;
    return sample;
}

render::Raster<SurfaceSample> row(const std::vector<SurfaceSample>& pixels) {
    render::Raster<SurfaceSample> raster(static_cast<int>(pixels.size()), 1);
    raster.pixels = pixels;
    return raster;
}

TEST(ShadowClasses, OfTheDrawnPicture) {
    const auto classes = drawnClasses(row({SurfaceSample(), surface(-1), surface(1), surface(1.25F), surface(2.125F)}));
    const std::vector expected = {
        ShadowClass::Background, ShadowClass::FacesAway, ShadowClass::Dark, ShadowClass::Lit, ShadowClass::Dark};
    EXPECT_EQ(classes.pixels, expected);
}

TEST(ShadowClasses, OfEachStatus) {
    struct Row {
        bool isSurface;
        std::uint8_t status;
        ShadowClass expected;
    };

    const std::vector<Row> rows = {
        {false, render::kNoSample, ShadowClass::Background},
        {true, render::kNoSample, ShadowClass::FacesAway},
        {true, exact::kLit, ShadowClass::Lit},
        {true, exact::kDark, ShadowClass::Dark},
        {true, exact::kDark | exact::kWithinTolerance, ShadowClass::Dark},
        {true, exact::kDarkByEdge, ShadowClass::WithinTolerance},
        {true, exact::kWithinTolerance, ShadowClass::WithinTolerance},
        {true, exact::kDarkByEdge | exact::kWithinTolerance, ShadowClass::WithinTolerance},
    };
    for (const Row& each : rows) {
        render::Raster<std::uint8_t> status(1, 1, each.status);
        const auto classes = trueClasses(row({each.isSurface ? surface(1) : SurfaceSample()}), status);
        EXPECT_EQ(classes.pixels, std::vector{each.expected}) << int{each.status};
    }
}

TEST(ShadowClasses, AreGreyLevels) {
    render::Raster<ShadowClass> classes(2, 1);
    classes.pixels = {ShadowClass::FacesAway, ShadowClass::Lit};
    const std::vector<render::Rgb> expected = {{64, 64, 64}, {255, 255, 255}};
    EXPECT_EQ(pictureOf(classes).pixels, expected);
}

} // namespace
} // namespace gnomon::validation
