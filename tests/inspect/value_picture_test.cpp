// Colours that tell values of the surface, pixel by pixel: against the view's own geometry, and against other ways to
// find what is seen there.
#include "core/error.h"
#include "core/random.h"
#include "frame/drawn_point.h"
#include "inspect/seen_values.h"
#include "inspect/value_picture.h"
#include "render/overlay/color_map.h"
#include "render/software_backend.h"
#include "settings/backend_choice.h"
#include "settings/usage_error.h"
#include "settings/value_colors.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gnomon::inspect {
namespace {

using settings::ColorBy;

TEST(ValueColors, ReadTheirRange) {
    const auto range = settings::valueRange();
    EXPECT_EQ(range.read("-1.5,2e3"), (std::array{-1.5, 2000.0}));
    for (const char* wrong : {"", "1", "2,1", "1,1", "a,2", "1,nan", "1,2,3"})
        EXPECT_FALSE(range.read(wrong)) << wrong;
    EXPECT_EQ(range.write({-1.5, 2000}), "-1.5,2000");
}

// Factors of two of a field that spans more than a decade are as far apart as those of errors.
TEST(ValueColors, OfWideFieldsGoByTheirLogarithm) {
    settings::ValueColors colors;
    colors.by = settings::ColorBy::Field;
    colors.field = "intensity";
    const auto expect = [&](std::array<double, 2> usual, bool isLogarithmic, double min) {
        const render::ValueScale scale = valueScale(colors, usual);
        EXPECT_EQ(scale.isLogarithmic, isLogarithmic) << usual[0] << " to " << usual[1];
        EXPECT_EQ(scale.min, min);
        EXPECT_EQ(scale.max, colors.range ? (*colors.range)[1] : usual[1]);
    };
    expect({1, 9}, false, 1);
    expect({1, 11}, true, 1);
    expect({1, 640}, true, 10);
    expect({0, 640}, false, 0);
    expect({-1, 640}, false, -1);
    colors.range = {{2, 2000}};
    expect({0, 1}, true, 2);
    colors.range = {{0, 2000}};
    expect({1, 640}, false, 0);
    colors.range.reset();
    colors.by = settings::ColorBy::Height;
    expect({1, 640}, false, 1);
    colors.by = settings::ColorBy::Error;
    expect({1, 2}, true, 1);
}

TEST(ValueColors, SlopeAndHeightAreThoseOfTheWorldsUp) {
    const glm::dvec3 up(0, 0, 7);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Height, {1, 2, 3}, {1, 0, 0}, up), 3);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Slope, {1, 2, 3}, {1, 0, 0}, up), 90);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Slope, {1, 2, 3}, {0, 0, -1}, up), 0);
    EXPECT_NEAR(valueOf(ColorBy::Slope, {}, glm::normalize(glm::dvec3(1, 0, 1)), up), 45, 1e-12);
    EXPECT_EQ(heightRange({{-1, -2, -3}, {4, 5, 6}}, up), (std::array{-3.0, 6.0}));
    EXPECT_EQ(heightRange({{-1, -2, -3}, {4, 5, 6}}, {-2, 0, 0}), (std::array{-4.0, 1.0}));
}

TEST(ValueColors, EachPixelHasTheColourOfWhereItsRayMeetsTheGround) {
    const glm::dvec3 far(500000, 5000000, 300); // as of UTM, where floats know metres only
    tests::SceneMesh scene(far);
    scene.addQuad({-8, 0, -8}, {16, 4, 0}, {0, 0, 16}); // rises by a quarter along x
    frame::DrawnModel model(scene.model());
    plan::View view;
    view.width = view.height = 64;
    view.camera = {far + glm::dvec3(0, 30, 0.1), far, {0, 0, -1}, 0.5};
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Off;
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    const frame::Frame frame = model.draw(view, quality, options);
    settings::ValueColors colors;
    colors.by = ColorBy::Height;
    colors.map = plan::ColorMap::Grey;
    render::Picture picture = model.backend().picture();
    colorByValues(colors, model.renderer(), frame, picture);
    const Box bounds = model.file().summary().bounds;
    const CameraBasis basis = cameraBasis(view.camera);
    int compared = 0;
    for (int y = 0; y < 32; ++y) // the legend lies below
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 ray = basis.view + ((x + 0.5) / 32 - 1) * view.tanHalfX() * basis.right +
                                   (1 - (y + 0.5) / 32) * view.tanHalfY() * basis.up;
            const glm::dvec3 eye = view.camera.eye - far;
            const double t = (eye.y - eye.x / 4 - 2) / (ray.x / 4 - ray.y); // on y = 2 + x / 4
            const glm::dvec3 p = eye + t * ray;
            if (std::max(std::abs(p.x), std::abs(p.z)) > 7.9) continue;
            const double part = (p.y + far.y - bounds.min.y) / (bounds.max.y - bounds.min.y);
            const double grey = 255 * (0.15 + 0.8 * part);
            EXPECT_NEAR(picture.at(x, y)[0], grey, 1.01) << x << ", " << y;
            ++compared;
        }
    EXPECT_GT(compared, 500);
}

TEST(ValueColors, AreReadFromTheWordsOfAPerson) {
    using settings::valueColors;
    EXPECT_EQ(valueColors({}).by, ColorBy::None);
    EXPECT_EQ(valueColors({"error", "grey", "0,2"}).range, (std::array{0.0, 2.0}));
    EXPECT_EQ(valueColors({"intensity", "", ""}).by, ColorBy::Field);
    EXPECT_EQ(valueColors({"intensity", "", ""}).field, "intensity");
    EXPECT_EQ(valueColors({"vertex", "cividis", ""}).map, plan::ColorMap::Cividis);
    for (const settings::ValueColorWords& wrong :
         {settings::ValueColorWords{"error", "pink", ""}, {"", "", "0,2"}, {"vertex", "", "0,2"}, {"slope", "", "2,0"}})
        EXPECT_THROW((void)valueColors(wrong), settings::UsageError) << wrong.by << wrong.map << wrong.range;
    settings::Settings settings;
    EXPECT_FALSE(settings::softwareNeed(settings, valueColors({"height", "", ""})));
    EXPECT_TRUE(settings::softwareNeed(settings, valueColors({"error", "", ""})));
    settings.backend = settings::Backend::Egl;
    EXPECT_NO_THROW(settings::requireCapable(settings, valueColors({"slope", "", ""})));
    EXPECT_THROW(settings::requireCapable(settings, valueColors({"vertex", "", ""})), settings::UsageError);
}

/// Hills with colours of several levels, seen from aside.
class ColoredHills {
public:
    explicit ColoredHills(double errorPixels, plan::Shading shading = plan::Shading::Lit) : model_(hills()) {
        plan::View view;
        view.width = 120;
        view.height = 90;
        view.camera = {{30, 20, 34}, {16, 1, 16}, {0, 1, 0}, 0.9};
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Off;
        quality.errorPixels = errorPixels;
        quality.look.shading = shading;
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        frame_ = model_.draw(view, quality, options);
    }

    frame::DrawnModel& model() { return model_; }

    const frame::Frame& frame() const { return frame_; }

private:
    static tests::TinyModel hills() {
        tests::TinyModelOptions options;
        options.colors = true;
        return tests::makeTinyModel(options);
    }

    frame::DrawnModel model_;
    frame::Frame frame_;
};

TEST(SeenValues, ErrorsAreThoseOfTheClustersOnTheLinesOfSight) {
    std::set<double> errors;
    for (const double errorPixels : {0.5, 3.0, 12.0}) {
        ColoredHills hills(errorPixels);
        const ValuePicture seen = seenErrors(hills.model().renderer(), hills.frame());
        int compared = 0, unlike = 0;
        for (int y = 0; y < seen.height; y += 2)
            for (int x = 0; x < seen.width; x += 3) {
                const auto drawn = frame::drawnPoint(hills.model().renderer(), hills.frame(), {}, {x, y});
                if (!drawn || std::isnan(seen.at(x, y))) continue;
                ++compared;
                unlike += seen.at(x, y) == drawn->vertex->within ? 0 : 1;
                errors.insert(seen.at(x, y));
            }
        EXPECT_GT(compared, 500);
        EXPECT_LT(unlike, compared / 30); // along the borders of clusters, which pictures round to the pixel
    }
    EXPECT_GT(errors.size(), 4U);
}

TEST(SeenValues, StoredColoursAreThoseOfAnUnlitPicture) {
    ColoredHills hills(1, plan::Shading::Unlit);
    const render::Picture unlit = hills.model().backend().picture();
    const render::Picture stored = seenColors(hills.model().renderer(), hills.frame());
    settings::ValueColors colors;
    colors.by = ColorBy::Vertex;
    render::Picture painted = unlit;
    colorByValues(colors, hills.model().renderer(), hills.frame(), painted);
    const ValuePicture errors = seenErrors(hills.model().renderer(), hills.frame());
    std::set<render::Rgb> found;
    for (std::size_t i = 0; i < unlit.pixels.size(); ++i) {
        if (std::isnan(errors.pixels[i])) continue;
        found.insert(stored.pixels[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_NEAR(stored.pixels[i][c], unlit.pixels[i][c], 2) << i;
            ASSERT_NEAR(painted.pixels[i][c], unlit.pixels[i][c], 2) << i; // no legend, no shadow
        }
    }
    EXPECT_GT(found.size(), 100U);
}

TEST(SeenValues, WhatAModelLacksIsSaid) {
    ColoredHills hills(1);
    try {
        (void)seenField(hills.model().renderer(), hills.frame(), "rain");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("vertex, height, slope, error"), std::string::npos) << error.what();
    }
    tests::SceneMesh scene;
    scene.addGround(4, 2);
    frame::DrawnModel plain(scene.model());
    plan::View view;
    view.camera = {{0, 9, 0.1}, {0, 0, 0}, {0, 0, -1}, 1};
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Off;
    const frame::Frame frame = plain.draw(view, quality, options);
    EXPECT_THROW((void)seenColors(plain.renderer(), frame), Error);
}

/// How far `point` is from a triangle, at most: from its plane, and from what lies within its edges.
double distanceTo(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    double max = std::abs(glm::dot(normal, point - corners[0]));
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
        const double inside = glm::dot(normal, glm::cross(glm::normalize(edge), point - corners[i]));
        max = std::max(max, -inside);
    }
    return max;
}

plan::View randomViewOfHills(Random& random, int round) {
    plan::View view;
    view.width = 80;
    view.height = 60;
    const glm::dvec3 middle(16, 1, 16);
    view.camera.target = middle + glm::dvec3(random.uniform(-4, 4), 0, random.uniform(-4, 4));
    view.camera.eye = middle + glm::dvec3(random.uniform(-25, 25), random.uniform(5, 25), random.uniform(-25, 25));
    if (round % 2 == 1) view.camera.projection = Projection::Orthographic;
    if (round % 3 == 2) {
        Plane plane{glm::normalize(glm::dvec3(random.uniform(-1, 1), 0.2, random.uniform(-1, 1))), 0};
        plane.offset = -glm::dot(plane.normal, middle);
        view.sections.push_back(plane);
    }
    return view;
}

TEST(SeenTriangles, HoldThePointsThatTheSurfacesShow) {
    Random random(3);
    tests::TinyModelOptions shape;
    shape.seed = 4;
    frame::DrawnModel model(tests::makeTinyModel(shape));
    int seenCount = 0, none = 0;
    for (int round = 0; round < 9; ++round) {
        const plan::View view = randomViewOfHills(random, round);
        plan::Quality quality;
        quality.shadows = round % 2 == 0 ? plan::ShadowMode::Off : plan::ShadowMode::Exact;
        quality.errorPixels = round % 2 == 0 ? 1 : 5;
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        const frame::Frame frame = model.draw(view, quality, options);
        const auto seen = model.backend().seenTriangles();
        const auto surfaces = model.backend().surfaces();
        const auto resident = model.renderer().residency().resident();
        const hierarchy::Grid& grid = model.file().summary().grid;
        ASSERT_EQ(seen.pixels.size(), surfaces.pixels.size());
        for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
            const render::SeenTriangle& triangle = seen.pixels[i];
            ASSERT_EQ(triangle.page != hierarchy::kNone, surfaces.pixels[i].isSurface > 0) << round << ", " << i;
            ++(triangle.page == hierarchy::kNone ? none : seenCount);
            if (triangle.page == hierarchy::kNone) continue;
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = grid.world(resident[triangle.page]->vertices.at(triangle.vertices[k]).position);
            const glm::dvec3 point = grid.world(frame.space.originCell) + glm::dvec3(surfaces.pixels[i].position);
            // Places within pixels are rounded to a 256th, and what is seen at a slant is far from its neighbour.
            ASSERT_LT(distanceTo(corners, point), 0.05) << round << ", " << i;
            ASSERT_LT(triangle.cluster, resident[triangle.page]->clusters.size());
        }
    }
    EXPECT_GT(seenCount, 5000);
    EXPECT_GT(none, 2000);
}

} // namespace
} // namespace gnomon::inspect
