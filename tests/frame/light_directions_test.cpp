// Penumbrae and the light of the sky, as pictures hold them, against closed forms and frames that are drawn one by one.
#include "frame/accumulation.h"
#include "plan/light_directions.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace gnomon::frame {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

/// A level floor under something, seen from above its middle.
plan::View viewAboveFloor(const glm::dvec3& eye, const glm::dvec3& target) {
    plan::View view;
    view.width = 96;
    view.height = 64;
    view.camera.eye = eye;
    view.camera.target = target;
    view.towardsLight = {0, 1, 0};
    return view;
}

plan::Quality exactQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.look.shading = plan::Shading::Lit;
    return quality;
}

/// Where the floor y = 0 is seen at a place in the image, in pixels from its upper left corner.
glm::dvec3 onFloor(const plan::View& view, const glm::dvec2& place) {
    const CameraBasis basis = cameraBasis(view.camera);
    const double x = (2 * place.x / view.width - 1) * view.tanHalfX();
    const double y = (1 - 2 * place.y / view.height) * view.tanHalfY();
    const glm::dvec3 ray = basis.view + x * basis.right + y * basis.up;
    return view.camera.eye - ray * (view.camera.eye.y / ray.y);
}

/// The mean of `of` over a pixel of the floor.
template <class Of>
double overPixel(const plan::View& view, int x, int y, const Of& of) {
    constexpr int kSide = 8;
    const auto place = [](int i) { return (i + 0.5) / kSide; };
    double sum = 0;
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
            sum += of(onFloor(view, {x + place(column), y + place(row)}));
    return sum / (kSide * kSide);
}

/// The light of the mean of as many frames as the plan of `view` calls for.
render::LightPicture meanLight(
    DrawnModel& model, const plan::View& view, const plan::Quality& quality, int samples, int* frames = nullptr) {
    FrameOptions options;
    options.isAccumulated = true;
    const Frame frame = model.draw(view, quality, options);
    Accumulation accumulation;
    accumulation.begin(model.renderer(), frame, samples);
    while (accumulation.samples() < accumulation.wanted())
        accumulation.add();
    if (frames != nullptr) *frames = accumulation.wanted();
    return accumulation.light();
}

double discOutside(double distance) {
    const double x = std::clamp(distance, -1.0, 1.0);
    return (std::acos(x) - x * std::sqrt(1 - x * x)) / kHalfTurn;
}

// A roof whose edge runs over the floor, and one that is a strip: each point's share of the sun's disc in closed form.
class RoofPenumbra : public testing::TestWithParam<double> {
protected:
    static constexpr double kHeight = 10;
    static constexpr double kAngle = 0.3; // a sun so wide that its penumbrae are many pixels

    /// The greatest difference to `share` of a point of the floor, over all pixels.
    static double worst(double roofWidth, const std::function<double(double)>& share) {
        tests::SceneMesh scene;
        scene.addGround(64, 16);
        scene.addQuad({-roofWidth, kHeight, -30}, {roofWidth, 0, 0}, {0, 0, 60});
        DrawnModel model(scene.model());
        plan::View view = viewAboveFloor({0.3, 8, 0}, {0, 0, 0.01});
        view.sunAngleRadians = kAngle;
        plan::Quality quality = exactQuality();
        quality.lightError = GetParam();
        quality.look.ambient = 0; // nothing but the sun
        int frames = 0;
        const render::LightPicture soft = meanLight(model, view, quality, 1, &frames);
        EXPECT_EQ(frames, plan::directionsFor(GetParam()));
        view.sunAngleRadians = 0;
        quality.shadows = plan::ShadowMode::Off;
        const render::LightPicture open = meanLight(model, view, quality, 1);
        double worst = 0;
        std::size_t penumbra = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double wanted = overPixel(view, x, y, [&](const glm::dvec3& p) { return share(p.x); });
                const double found = soft.at(x, y)[1] / open.at(x, y)[1];
                worst = std::max(worst, std::abs(found - wanted));
                penumbra += wanted > 0.02 && wanted < 0.98 ? 1 : 0;
            }
        EXPECT_GT(penumbra, 500U);
        return worst;
    }

    /// Of the disc, in its radii, how far its middle lies on the light side of an edge that is seen from `x` over
    /// `edge`.
    static double beside(double x, double edge) { return (x - edge) / (kHeight * std::tan(kAngle / 2)); }
};

TEST_P(RoofPenumbra, OfAHalfPlaneIsWithinTheError) {
    EXPECT_LE(worst(30, [](double x) { return discOutside(-beside(x, 0)); }), GetParam());
}

TEST_P(RoofPenumbra, OfAStripIsWithinTwiceTheError) {
    const double width = 1.5;
    const auto share = [width](double x) { return discOutside(-beside(x, 0)) + discOutside(beside(x, -width)); };
    EXPECT_LE(worst(width, share), 2 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Errors, RoofPenumbra, testing::Values(0.1, 0.05, 0.02));

TEST(Penumbra, TooNarrowToShowIsLeftOut) {
    DrawnModel model(crateOnGround().model());
    plan::View view = overGround();
    FrameOptions options;
    options.isAccumulated = true;
    view.sunAngleRadians = 0.02;
    const Frame wide = model.draw(view, exactQuality(), options);
    EXPECT_GT(wide.plan.penumbra.directions, 1);
    // A beam passes through 3 between the crate's upper edge and the ground, and through as much again of the clusters
    // of the ground, which are 4 wide; 10 before the eye a pixel is 0.072 wide.
    EXPECT_LE(wide.plan.penumbra.widestPixels, 0.02 * 6 * std::sqrt(2 / 3.0 + 1) / 0.072 * 1.6);
    EXPECT_GE(wide.plan.penumbra.widestPixels, 0.02 * 2 / (0.0072 * 14));
    view.sunAngleRadians = 0.02 * 0.4 / wide.plan.penumbra.widestPixels;
    const Frame narrow = model.draw(view, exactQuality(), options);
    EXPECT_EQ(narrow.plan.penumbra.directions, 1);
    EXPECT_EQ(narrow.plan.omitted.back().effect, plan::Effect::Penumbra);
    view.sunAngleRadians = 0;
    EXPECT_LT(model.draw(view, exactQuality(), options).plan.omitted.size(), narrow.plan.omitted.size());
}

/// How much of the light of a level surface a canyon leaves to its floor, `x` from its middle (both walls are endless).
double canyonShare(double x, double width, double height) {
    const auto sine = [height](double reach) { return reach / std::hypot(reach, height); };
    return (sine(width / 2 - x) + sine(width / 2 + x)) / 2;
}

/// What an upright rectangle, as high as `height` and as wide as `width` from the foot that is nearest, `distance`
/// away, takes of a level surface at its foot's height (the view factor of perpendicular surfaces).
double uprightShare(double distance, double width, double height) {
    const double aslant = std::hypot(height, distance);
    return (std::atan(width / distance) - distance / aslant * std::atan(width / aslant)) / (2 * kHalfTurn);
}

/// The greatest difference to `share` of a point of the floor of `scene` in the light of the sky.
double worstSkyError(
    const tests::SceneMesh& scene,
    plan::View view,
    const plan::SkyLight& sky,
    const std::function<std::optional<double>(const glm::dvec3&)>& share) {
    DrawnModel model(scene.model());
    view.towardsLight = {0, -1, 0}; // the sun stands in the nadir, so the sky is brightest above
    plan::Quality quality = exactQuality();
    const render::LightPicture open = meanLight(model, view, quality, sky.directions);
    quality.sky = sky;
    const render::LightPicture with = meanLight(model, view, quality, 1);
    double worst = 0;
    std::size_t looked = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::optional<double> wanted = share(onFloor(view, {x + 0.5, y + 0.5}));
            if (!wanted) continue;
            ++looked;
            // The sky is bluer than what comes from the eye, by 0.1 of white; 0.51 of it is green.
            const double white = (open.at(x, y)[2] - open.at(x, y)[0]) / 0.1;
            const double found = 1 + (with.at(x, y)[1] - open.at(x, y)[1]) / (0.51 * white);
            worst = std::max(worst, std::abs(found - *wanted));
        }
    EXPECT_GT(looked, 300U);
    return worst;
}

TEST(SkyLight, OfAStreetCanyonIsWithinItsError) {
    constexpr double kWidth = 8;
    constexpr double kHeight = 6;
    tests::SceneMesh scene;
    scene.addGround(64, 16);
    scene.addBox({-20, 0, -3000}, {-kWidth / 2, kHeight, 3000});
    scene.addBox({kWidth / 2, 0, -3000}, {20, kHeight, 3000});
    const plan::View view = viewAboveFloor({0, 5, 0}, {0, 0, 0.01});
    const auto share = [](const glm::dvec3& p) -> std::optional<double> {
        if (std::abs(p.x) > kWidth / 2 - 0.2) return std::nullopt;
        return canyonShare(p.x, kWidth, kHeight);
    };
    for (const int directions : {64, 256})
        EXPECT_LE(worstSkyError(scene, view, {directions}, share), plan::skyError(directions, plan::SkyModel::Uniform))
            << directions;
}

TEST(SkyLight, BeforeABoxInTheOpenIsWithinItsError) {
    tests::SceneMesh scene;
    scene.addGround(64, 16);
    scene.addBox({-3, 0, -4}, {3, 4, -1});
    const plan::View view = viewAboveFloor({0, 6, 4}, {0, 0, 1});
    const auto share = [](const glm::dvec3& p) -> std::optional<double> {
        if (p.z < -0.8 || std::abs(p.x) > 2.9) return std::nullopt;
        return 1 - uprightShare(p.z + 1, 3 - p.x, 4) - uprightShare(p.z + 1, 3 + p.x, 4);
    };
    for (const int directions : {64, 256})
        EXPECT_LE(worstSkyError(scene, view, {directions}, share), plan::skyError(directions, plan::SkyModel::Uniform))
            << directions;
}

// A corner of two walls: what each takes of the sky, added, since neither stands behind the other.
TEST(SkyLight, InACornerIsWithinItsErrorOverAnOvercastSkyToo) {
    constexpr double kWall = 4;
    tests::SceneMesh scene;
    scene.addGround(64, 16);
    scene.addBox({-1, 0, -1}, {kWall, kWall, 0});
    scene.addBox({-1, 0, 0}, {0, kWall, kWall});
    const plan::View view = viewAboveFloor({6, 9, 6}, {1.5, 0, 1.5});
    const auto onCorner = [](const glm::dvec3& p) { return p.x > 0.2 && p.z > 0.2 && p.x < kWall && p.z < kWall; };
    const auto uniform = [&](const glm::dvec3& p) -> std::optional<double> {
        if (!onCorner(p)) return std::nullopt;
        const auto wall = [](double distance, double beside) {
            return uprightShare(distance, beside, kWall) + uprightShare(distance, kWall - beside, kWall);
        };
        return 1 - wall(p.z, p.x) - wall(p.x, p.z);
    };
    // What two walls leave of a sky of that brightness, summed over a fine lattice of it.
    const auto overcast = [&](const glm::dvec3& p) -> std::optional<double> {
        if (!onCorner(p)) return std::nullopt;
        constexpr int kParts = 5000;
        double sum = 0;
        for (int i = 0; i < kParts; ++i) {
            const plan::SkyPart part = plan::skyPart(i, kParts, plan::SkyModel::Overcast, {0, 1, 0});
            const auto isHidden = [&](int across, int along) {
                if (part.direction[across] >= 0) return false;
                const glm::dvec3 met = p - part.direction * (p[across] / part.direction[across]);
                return met.y < kWall && met[along] < kWall && met[along] > -1;
            };
            if (!isHidden(0, 2) && !isHidden(2, 0)) sum += part.weight * part.direction.y;
        }
        return sum / kParts;
    };
    EXPECT_LE(worstSkyError(scene, view, {64}, uniform), plan::skyError(64, plan::SkyModel::Uniform));
    const plan::SkyLight grey{64, plan::SkyModel::Overcast};
    EXPECT_LE(worstSkyError(scene, view, grey, overcast), plan::skyError(64, grey.model));
}

// A ridge sees all of the sky, and no longer where there is a crate on it; a valley does not.
TEST(SkyLight, IsLeftOutWhereNothingHidesAnyOfIt) {
    plan::View view = overGround();
    view.camera.eye = {9, 12, 30};
    plan::Quality quality = exactQuality();
    quality.sky.directions = 64;
    const auto planned = [&](double fold, bool hasCrate) {
        tests::SceneMesh scene;
        scene.addQuad({-4, -fold, -4}, {4, fold, 0}, {0, 0, 8});
        scene.addQuad({0, 0, -4}, {4, -fold, 0}, {0, 0, 8});
        if (hasCrate) scene.addBox({1, -fold, -1}, {2, 1, 1});
        DrawnModel model(scene.model());
        return model.draw(view, quality).plan;
    };
    for (const double fold : {0.0, 1.0, -1.0}) {
        const plan::FramePlan open = planned(fold, false);
        EXPECT_EQ(open.sky.directions, fold < 0 ? 64 : 0) << fold;
        const plan::SkippedEffect skipped{plan::Effect::SkyLight, plan::SkipReason::NothingHidesTheSky};
        EXPECT_EQ(std::count(open.omitted.begin(), open.omitted.end(), skipped), fold < 0 ? 0 : 1) << fold;
        EXPECT_EQ(planned(fold, true).sky.directions, 64);
    }
}

/// The mean of light in doubles, over the frames that cover a pixel.
class PlainLightMean {
public:
    explicit PlainLightMean(std::size_t pixels) : sums_(pixels), covered_(pixels) {}

    void add(const render::LightPicture& sun, const render::LightPicture& sky) {
        for (std::size_t p = 0; p < sums_.size(); ++p) {
            if (sun.pixels[p][0] < 0) continue;
            ++covered_[p];
            for (std::size_t c = 0; c < 3; ++c)
                sums_[p][c] += static_cast<double>(sun.pixels[p][c]) + static_cast<double>(sky.pixels[p][c]);
        }
    }

    /// How many values of `found` are not its.
    std::size_t apartFrom(const render::LightPicture& found) const {
        std::size_t apart = 0;
        for (std::size_t p = 0; p < sums_.size(); ++p) {
            apart += (found.pixels[p][0] >= 0) != (covered_[p] > 0) ? 1 : 0;
            for (std::size_t c = 0; c < 3 && covered_[p] > 0; ++c)
                apart += std::abs(found.pixels[p][c] - sums_[p][c] / covered_[p]) > 2e-6 ? 1 : 0;
        }
        return apart;
    }

private:
    std::vector<std::array<double, 3>> sums_;
    std::vector<int> covered_;
};

// Directions, offsets and parts of light in one loop: the sum of frames that are drawn one by one, each from its own
// direction, with maps, exact shadows and rays.
TEST(LightFrames, AreTheMeanOfFramesDrawnOneByOne) {
    const tests::SceneMesh scene = crateOnGround();
    for (const plan::ShadowMode shadows : {plan::ShadowMode::Maps, plan::ShadowMode::Exact, plan::ShadowMode::Rays}) {
        DrawnModel model(scene.model());
        plan::View view = overGround();
        view.width = view.height = 48;
        view.sunAngleRadians = 0.2;
        plan::Quality quality = exactQuality();
        quality.shadows = shadows;
        quality.lightError = 0.3;
        quality.sky = {5, plan::SkyModel::Overcast};
        int frames = 0;
        const render::LightPicture found = meanLight(model, view, quality, 9, &frames);
        ASSERT_EQ(frames, 9);
        PlainLightMean mean(found.pixels.size());
        for (int i = 0; i < frames; ++i) {
            FrameOptions options;
            options.isAccumulated = true;
            options.subpixel = subpixelOffset(i);
            options.mapShift = mapShift(i);
            const auto lightFrom = [&](const glm::dvec3& direction, render::LightPart part, double weight) {
                plan::View turned = view;
                turned.towardsLight = direction;
                options.lightPart = part;
                options.skyWeight = weight;
                model.draw(turned, quality, options);
                return model.backend().light();
            };
            const glm::dvec3 towards = plan::towardsDisc(view.towardsLight, 0.2, plan::discPoint(i, frames));
            const render::LightPicture sun = lightFrom(towards, render::LightPart::WithoutSky, 0);
            const plan::SkyPart part = plan::skyPart(i, frames, quality.sky.model, view.up);
            mean.add(sun, lightFrom(part.direction, render::LightPart::SkyDirection, part.weight));
        }
        EXPECT_EQ(mean.apartFrom(found), 0U) << static_cast<int>(shadows);
    }
}

// A lamp 10^6 sizes of the scene away is the directional light towards it, in shadow and brightness; with a sky as
// well.
TEST(Lamp, FarAwayLightsAsADirectionDoes) {
    DrawnModel model(crateOnGround().model());
    for (const int directions : {0, 5}) {
        plan::View view = overGround();
        view.width = view.height = 48;
        plan::Quality quality = exactQuality();
        quality.sky.directions = directions;
        const render::LightPicture sun = meanLight(model, view, quality, 4);
        plan::View lit = view;
        const double distance = 64e6;
        lit.pointLight = {distance * glm::normalize(view.towardsLight), distance};
        const render::LightPicture lamp = meanLight(model, lit, quality, 4);
        int different = 0;
        for (std::size_t i = 0; i < sun.pixels.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                different += std::abs(sun.pixels[i][c] - lamp.pixels[i][c]) > 1e-4F * (1 + std::abs(sun.pixels[i][c]));
        EXPECT_EQ(different, 0) << directions;
    }
}

// On a floor that nothing shades a lamp at height h gives h / r^3 of its strength.
TEST(Lamp, FallsOffWithTheSquareOfTheDistance) {
    tests::SceneMesh scene;
    scene.addGround(64, 16);
    DrawnModel model(scene.model());
    plan::View view = viewAboveFloor({0, 12, 0}, {0, 0, 0.01});
    view.pointLight = {{2, 4, 1}, 3};
    for (const plan::ShadowMode mode : {plan::ShadowMode::Exact, plan::ShadowMode::Rays, plan::ShadowMode::Off}) {
        plan::Quality quality = exactQuality();
        quality.shadows = mode;
        quality.look.ambient = 0;
        const render::LightPicture light = meanLight(model, view, quality, 1);
        const auto relative = [&](int x, int y) {
            const glm::dvec3 way = view.pointLight->at - onFloor(view, {x + 0.5, y + 0.5});
            return light.pixels[light.index(x, y)][1] * std::pow(glm::length(way), 3) / way.y;
        };
        const double first = relative(0, 0);
        for (int y = 0; y < view.height; y += 7)
            for (int x = 0; x < view.width; x += 5)
                EXPECT_NEAR(relative(x, y) / first, 1, 1e-4) << x << " " << y;
        plan::View sunlit = view;
        sunlit.pointLight.reset();
        const render::LightPicture sun = meanLight(model, sunlit, quality, 1);
        EXPECT_NEAR(first / sun.pixels[0][1], 9, 1e-3) << "as bright as the sun 3 away";
    }
}

} // namespace
} // namespace gnomon::frame
