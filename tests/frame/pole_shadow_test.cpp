// A pole's shadow on a plane through a year: its tip as exact shadows show it lies where the sun says, within a pixel,
// and a sun 0.02 degrees beside it would not do.
#include "core/angle.h"
#include "settings/sun_settings.h"
#include "sun/civil_time.h"
#include "sun/sun_period.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::frame {
namespace {

constexpr double kPoleHeight = 32;
constexpr double kPoleHalfWidth = 1.0 / 16;
constexpr double kShadowPixel = 1.0 / 256; // seen from the tip's height as 0.007 degrees
constexpr int kWindow = 96;                // pixels

/// Towards a sun that stands so, with y up and north along -z.
glm::dvec3 towards(double azimuthDegrees, double elevationDegrees) {
    const double azimuth = radiansFromDegrees(azimuthDegrees);
    const double elevation = radiansFromDegrees(elevationDegrees);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

/// Whether a ray from a point of the plane towards the sun meets the pole: the box of its slabs.
bool isInPolesShadow(const glm::dvec2& point, const glm::dvec3& sun) {
    double first = 0;
    double last = kPoleHeight / sun.y;
    for (const auto& [from, along] : {std::pair{point.x, sun.x}, std::pair{point.y, sun.z}}) {
        if (along == 0 && std::abs(from) >= kPoleHalfWidth) return false;
        if (along == 0) continue;
        const double a = (-kPoleHalfWidth - from) / along;
        const double b = (kPoleHalfWidth - from) / along;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first < last;
}

/// The plane about `middle`, straight from above, north up.
plan::View planAbout(const glm::dvec2& middle) {
    constexpr double kAbove = 64;
    plan::View view;
    view.width = view.height = kWindow;
    view.camera.eye = {middle.x, kAbove, middle.y};
    view.camera.target = {middle.x, 0, middle.y};
    view.camera.up = {0, 0, -1};
    view.camera.projection = Projection::Orthographic;
    view.camera.fovYRadians = 2 * std::atan(kWindow * kShadowPixel / 2 / kAbove);
    return view;
}

/// Of the pixels of a picture of the plane about `middle` those that `sun` says otherwise of.
struct Mismatch {
    int all = 0;
    int inside = 0; // by more than a pixel from any border of the shadow
};

Mismatch mismatchOf(
    const render::Raster<render::SurfaceSample>& surfaces, const glm::dvec2& middle, const glm::dvec3& sun) {
    Mismatch mismatch;
    for (int row = 0; row < kWindow; ++row)
        for (int column = 0; column < kWindow; ++column) {
            const render::SurfaceSample& surface = surfaces.at(column, row);
            EXPECT_TRUE(surface.isLitSide());
            const bool isDark = surface.litFraction() < 0.5F;
            const glm::dvec2 point =
                middle + kShadowPixel * (glm::dvec2(column, row) + 0.5 - glm::dvec2(kWindow) / 2.0);
            if (isDark == isInPolesShadow(point, sun)) continue;
            ++mismatch.all;
            bool isBeside = false;
            for (const glm::dvec2 step : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
                isBeside = isBeside || isDark == isInPolesShadow(point + kShadowPixel * step, sun);
            mismatch.inside += isBeside ? 0 : 1;
        }
    return mismatch;
}

/// How many of four suns, 0.02 degrees higher, lower and to each side, the picture says otherwise of.
int refuted(
    const render::Raster<render::SurfaceSample>& surfaces, const glm::dvec2& middle, const sun::SunPosition& at) {
    int count = 0;
    for (const double off : {-0.02, 0.02}) {
        const double turned = off / std::cos(radiansFromDegrees(at.elevationRefracted));
        for (const glm::dvec3& other :
             {towards(at.azimuth, at.elevationRefracted + off), towards(at.azimuth + turned, at.elevationRefracted)})
            count += mismatchOf(surfaces, middle, other).inside > 0 ? 1 : 0;
    }
    return count;
}

TEST(PoleShadow, TipLiesWhereTheSunSaysThroughAYear) {
    tests::SceneMesh scene;
    scene.addGround(512, 16);
    scene.addBox({-kPoleHalfWidth, 0, -kPoleHalfWidth}, {kPoleHalfWidth, kPoleHeight, kPoleHalfWidth});
    DrawnModel model(scene.model());
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    FrameOptions options;
    options.wantsSurfaces = true;
    const sun::Place place{.latitude = 47.4, .longitude = 8.5};
    int drawn = 0;
    int refutedTips = 0; // of suns 0.02 degrees beside
    for (int month = 1; month <= 12; ++month)
        for (const char* hour : {"09:10", "12:25", "15:40"}) {
            const std::string when =
                "2026-" + std::string(month < 10 ? "0" : "") + std::to_string(month) + "-21T" + hour + "+01:00";
            SCOPED_TRACE(when);
            const sun::SunPosition at = settings::sunAt(place, sun::parseCivilTime(when).value()).position;
            if (at.elevationRefracted < 8) continue; // the shadow leaves the plane
            const glm::dvec3 sun = towards(at.azimuth, at.elevationRefracted);
            const glm::dvec2 tip = -glm::dvec2(sun.x, sun.z) * (kPoleHeight / sun.y);
            plan::View view = planAbout(tip);
            view.towardsLight = sun::towardsSun(at, 0, {0, 1, 0});
            model.draw(view, quality, options);
            const render::Raster<render::SurfaceSample> surfaces = model.backend().surfaces();
            const Mismatch found = mismatchOf(surfaces, tip, sun);
            EXPECT_EQ(found.inside, 0);
            EXPECT_LT(found.all, kWindow / 4) << "of borders";
            refutedTips += refuted(surfaces, tip, at);
            ++drawn;
        }
    EXPECT_GE(drawn, 30);
    EXPECT_EQ(refutedTips, 4 * drawn);
}

} // namespace
} // namespace gnomon::frame
