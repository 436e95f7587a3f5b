// Every contradiction and every requirement of the table is refused, and the error names its option.
#include "settings/contradictions.h"
#include "settings/table.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::settings {
namespace {

struct RefusedRequest {
    void (*request)(Request&);
    const char* option; // empty: sound
    const char* message = "";
};

UsageError objection(const Request& request) {
    try {
        requireSound(request);
        return {};
    } catch (const UsageError& error) {
        return error;
    }
}

void expectEach(const std::vector<RefusedRequest>& cases) {
    for (const RefusedRequest& each : cases) {
        Request request;
        each.request(request);
        const UsageError found = objection(request);
        EXPECT_EQ(found.option, each.option) << each.message << ", found " << found.message;
        EXPECT_EQ(found.message, each.message);
    }
}

TEST(Contradictions, OfCameras) {
    expectEach({
        {[](Request& r) { r.settings.cameraFile = "a.json"; }, ""},
        {[](Request& r) { r.settings.eye = r.settings.target = glm::dvec3(1); }, ""},
        {[](Request& r) {
             r.settings.cameraFile = "a.json";
             r.settings.eye = glm::dvec3(1, 2, 3);
         },
         "--camera",
         "--camera a.json and --eye 1,2,3 contradict each other: the camera file contains all values of the camera"},
        {[](Request& r) {
             r.settings.side = path::ViewSide::Left;
             r.settings.target = glm::dvec3(5);
         },
         "--view",
         "--view left and --target 5,5,5 contradict each other: --view sets the position of the camera"},
        {[](Request& r) {
             r.output.path = "walk.json";
             r.settings.fovYDegrees = 30;
         },
         "--path",
         "--path and --fov-y 30 contradict each other: the path contains the cameras"},
        {[](Request& r) {
             r.output.path = "walk.json";
             r.output.turntable = 3;
         },
         "--path",
         "--path and --turntable contradict each other: each of them sets the cameras"},
    });
}

TEST(Contradictions, OfLights) {
    expectEach({
        {[](Request& r) { r.settings.lightAt = glm::dvec3(1); }, ""},
        {[](Request& r) {
             r.settings.lightAt = glm::dvec3(0, 9, 0);
             r.settings.isLightGiven = true;
         },
         "--light-at",
         "--light-at 0,9,0 and --light 0.4,1,0.3 contradict each other: each of them sets the light"},
        {[](Request& r) {
             r.settings.lightAt = glm::dvec3(0, 9, 0);
             r.settings.sunAngleDegrees = 1;
         },
         "--light-at",
         "--light-at 0,9,0 and --sun-angle 1 contradict each other: the light of a lamp has no width"},
        {[](Request& r) {
             r.settings.lightAt = glm::dvec3(0, 9, 0);
             r.settings.quality.zPartitions = 2;
         },
         "--light-at",
         "--light-at 0,9,0 and --z-partitions 2 contradict each other: the maps of a lamp are the faces of a cube "
         "around it"},
        {[](Request& r) {
             r.settings.lightAt = glm::dvec3(0, 9, 0);
             r.settings.quality.look.ground = true;
         },
         "--light-at",
         "--light-at 0,9,0 and --ground on contradict each other: the ground shows the shadow of a direction"},
        {[](Request& r) {
             r.settings.quality.look.shading = plan::Shading::Unlit;
             r.settings.quality.shadows = plan::ShadowMode::Maps;
         },
         "--shading",
         "--shading unlit and --shadows maps contradict each other: this shading has no sun and no shadows"},
        {[](Request& r) {
             r.settings.quality.look.shading = plan::Shading::Unlit;
             askForMaps(r.settings);
         },
         "--shading",
         "--shading unlit and options of shadow maps contradict each other: this shading has no sun and no shadows"},
        {[](Request& r) { r.settings.north = 10; }, "--north", "--north 10 needs --sun LAT,LON,TIME"},
    });
}

TEST(Contradictions, OfMaps) {
    expectEach({
        {[](Request& r) { r.settings.quality.stabilize = true; }, ""},
        {[](Request& r) {
             r.settings.quality.stabilize = true;
             r.settings.eta = -1; // no warp
         },
         ""},
        {[](Request& r) {
             r.settings.quality.stabilize = true;
             r.settings.eta = 0.5;
         },
         "--stabilize",
         "--stabilize on and --eta 0.5 contradict each other: stabilised slices have no warp"},
        {[](Request& r) { r.settings.quality.stabilize = r.settings.isWarpGiven = true; },
         "--stabilize",
         "--stabilize on and --warp auto contradict each other: stabilised slices have no warp"},
        {[](Request& r) {
             r.settings.eta = 0.25;
             r.settings.isWarpGiven = true;
         },
         "--eta",
         "--eta 0.25 and --warp auto contradict each other: --eta sets the warp"},
        {[](Request& r) { r.settings.quality.near = r.settings.quality.far = 2; },
         "--shadow-near",
         "--shadow-near 2 and --shadow-far 2 contradict each other: --shadow-near must be below --shadow-far"},
        {[](Request& r) { r.settings.tsmFocus = 0; }, "--tsm-focus", "--tsm-focus auto needs --warp tsm"},
        {[](Request& r) {
             r.output.shadowDepth = "maps";
             r.settings.quality.shadows = plan::ShadowMode::Exact;
         },
         "--shadow-depth",
         "--shadow-depth and --shadows exact contradict each other: exact shadows have no maps"},
        {[](Request& r) {
             r.output.shadowClasses = "classes.png";
             r.settings.quality.shadows = plan::ShadowMode::Off;
         },
         "--shadow-classes",
         "--shadow-classes and --shadows off contradict each other: pixels have shadow classes only with a light and "
         "shadows"},
        {[](Request& r) {
             r.settings.backend = Backend::Egl;
             r.settings.quality.warp.rule = shadow::WarpRule::Log;
         },
         "--backend",
         "--backend egl and --warp log contradict each other: only the software backend draws logarithmic maps"},
    });
}

TEST(Contradictions, OfOutputs) {
    expectEach({
        {[](Request& r) { r.output = {.picture = "a.png", .samples = 5, .reference = "b.png"}; }, ""},
        {[](Request& r) { r.output = {.picture = "-", .turntable = 2}; }, ""},
        {[](Request& r) { r.output = {.picture = "a%d.png", .path = "walk.json", .frames = 3}; }, ""},
        {[](Request& r) { r.output = {.samples = 2, .statistics = "s.json"}; },
         "--samples",
         "--samples 2 and --stats contradict each other: it needs a single frame; use --samples 1"},
        {[](Request& r) {
             r.output.samples = 1;
             r.settings.quality.sky.directions = 8;
         },
         "--sky",
         "--sky 8 and --samples 1 contradict each other: the light of the sky needs several frames"},
        {[](Request& r) {
             r.output.reference = "b.png";
             r.settings.sunAngleDegrees = 0.5;
         },
         "--sun-angle",
         "--sun-angle 0.5 and --reference contradict each other: the light of a disc needs several frames"},
        {[](Request& r) { r.output = {.colors = {.by = ColorBy::Slope}, .turntable = 2}; },
         "--color-by",
         "--color-by and --turntable contradict each other: it colours one picture without an overlay"},
        {[](Request& r) { r.output = {.turntable = 2, .depth = "d.pfm"}; },
         "--turntable",
         "--turntable and --depth contradict each other: it needs a single picture"},
        {[](Request& r) {
             r.output = {.picture = "-", .turntable = 2};
             r.settings.quality.look.background.kind = plan::Background::Kind::Transparent;
         },
         "--background",
         "--background transparent and -o - contradict each other: YUV4MPEG2 has no alpha"},
        {[](Request& r) {
             r.output.overlay = render::Overlay::Lod;
             r.settings.quality.look.background.kind = plan::Background::Kind::Transparent;
         },
         "--background",
         "--background transparent and --overlay contradict each other: their legend needs a background"},
        {[](Request& r) { r.output.frames = 3; },
         "--frames",
         "--frames needs --path FILE.json; --turntable N gives the number of its pictures"},
        {[](Request& r) { r.output.time = 3; }, "--time", "--time needs a path: --camera PATH.json"},
        {[](Request& r) { r.output = {.picture = "a.png", .turntable = 2}; },
         "--output",
         "--output: expected - or a name with a number in it, such as frame%04d.png, found 'a.png'"},
        {[](Request& r) { r.output.picture = "a.jpg"; },
         "--output",
         "--output: expected a name ending in .png, found 'a.jpg'"},
    });
}

// The condition of an option without a condition of its own is its value in the settings.
TEST(Contradictions, NameOptionsOfTheTable) {
    const auto requireRow = [](const OptionUse& use) {
        EXPECT_TRUE(use.isUsed != nullptr || isSetting(use.option)) << use.option;
    };
    for (const Contradiction& each : contradictions()) {
        requireRow(each.option);
        for (const OptionUse& other : each.others)
            requireRow(other);
    }
    for (const Requirement& each : requirements())
        requireRow(each.option);
}

TEST(Samples, AreOneBesideAnOutputOfOneFrame) {
    EXPECT_EQ(samplesOf({}), kUsualSamples);
    EXPECT_EQ(samplesOf({.samples = 3}), 3);
    EXPECT_EQ(samplesOf({.overlay = render::Overlay::Lod}), 1);
    EXPECT_EQ(samplesOf({.colors = {.by = ColorBy::Slope}}), 1);
    EXPECT_EQ(samplesOf({.statistics = "a.json"}), 1);
    EXPECT_EQ(samplesOf({.reference = "a.png"}), 1);
    EXPECT_EQ(samplesOf({.samples = 5, .reference = "a.png"}), 5) << "pictures may be compared";
    EXPECT_EQ(samplesOf({.depth = "a.pfm"}), 1);
    EXPECT_EQ(samplesOf({.shadowClasses = "classes.png"}), 1);
    EXPECT_EQ(samplesOf({.shadowDepth = "maps"}), 1);
    EXPECT_EQ(samplesOf({.groundTruth = validation::GroundTruth::Exact}), 1);
}

} // namespace
} // namespace gnomon::settings
