// The backend that each command uses, and the options that only some backends can draw.
#include "settings/backend_choice.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <array>

namespace gnomon::settings {
namespace {

using plan::Capabilities;

struct Case {
    const char* name = "";
    BackendRequest request;
    Backend expected = Backend::Auto;
    const char* reason = "";
};

const BackendNeed kSection{"--section 0,0,0,0,1,0", "only the software backend draws sections"};
constexpr const char* kOnePicture = "it draws one picture in less time than a GPU takes to open";
constexpr const char* kNoGpu = "this machine has no GPU";
constexpr const char* kGpu = "this machine has a GPU";
constexpr const char* kNeed = "only the software backend draws sections (--section 0,0,0,0,1,0)";

TEST(BackendChoice, FollowsTheCommandThePicturesTheGpuAndTheNeeds) {
    using enum Backend;
    using enum DrawingCommand;
    const std::array cases = {
        Case{"a still", {Auto, Render, 1, false, {}}, Software, kOnePicture},
        Case{"a still beside a GPU", {Auto, Render, 1, true, {}}, Software, kOnePicture},
        Case{"a turntable", {Auto, Render, 60, false, {}}, Software, kNoGpu},
        Case{"a turntable beside a GPU", {Auto, Render, 60, true, {}}, Egl, kGpu},
        Case{"two pictures beside a GPU", {Auto, Render, 2, true, {}}, Egl, kGpu},
        Case{"a turntable with sections", {Auto, Render, 60, true, kSection}, Software, kNeed},
        Case{"a bench", {Auto, Bench, 1, false, {}}, Software, kNoGpu},
        Case{"a bench beside a GPU", {Auto, Bench, 1, true, {}}, Egl, kGpu},
        Case{"a bench with sections", {Auto, Bench, 1, true, kSection}, Software, kNeed},
        Case{"the window", {Auto, View, 1, false, {}}, Software, kNoGpu},
        Case{"the window on a GPU", {Auto, View, 1, true, {}}, Window, kGpu},
        Case{"the window with sections", {Auto, View, 1, true, kSection}, Software, kNeed},
        Case{"software on request", {Software, Bench, 1, true, {}}, Software, "it is requested"},
        Case{"OSMesa on request", {Osmesa, Render, 1, false, {}}, Osmesa, "it is requested"},
        Case{"EGL on request", {Egl, Render, 1, false, {}}, Egl, "it is requested"},
        Case{"the window's OpenGL on request", {Window, View, 1, false, {}}, Window, "it is requested"},
    };
    for (const Case& each : cases) {
        const BackendChoice choice = chooseBackend(each.request);
        EXPECT_EQ(choice.backend, each.expected) << each.name;
        EXPECT_EQ(choice.reason, each.reason) << each.name;
    }
}

TEST(BackendChoice, EveryNeedNamesItsOptionAndItsReason) {
    struct OfOption {
        void (*request)(Settings&, ValueColors&);
        const char* option;
        bool Capabilities::*capability;
    };

    const std::array options = {
        OfOption{
            [](Settings& s, ValueColors&) { s.quality.shadows = plan::ShadowMode::Exact; },
            "--shadows exact",
            &Capabilities::exactShadows},
        OfOption{
            [](Settings& s, ValueColors&) { s.quality.warp.rule = shadow::WarpRule::Log; },
            "--warp log",
            &Capabilities::unevenRows},
        OfOption{
            [](Settings& s, ValueColors&) { s.quality.cullCasters = plan::CasterCulling::Receivers; },
            "--cull-casters receivers",
            &Capabilities::imageFirst},
        OfOption{
            [](Settings& s, ValueColors&) { s.quality.occlusion = plan::Choice::On; },
            "--occlusion on",
            &Capabilities::occlusionCulling},
        OfOption{
            [](Settings& s, ValueColors&) { s.sections = {Section{}}; },
            "--section 0,0,0,0,1,0",
            &Capabilities::sections},
        OfOption{[](Settings& s, ValueColors&) { s.quality.look.ground = true; }, "--ground on", &Capabilities::ground},
        OfOption{
            [](Settings&, ValueColors& colors) { colors = {.by = ColorBy::Field, .field = "heat"}; },
            "--color-by heat",
            &Capabilities::seesTriangles},
    };
    for (const OfOption& each : options) {
        Settings settings;
        ValueColors colors;
        EXPECT_FALSE(softwareNeed(settings, colors));
        each.request(settings, colors);
        const auto need = softwareNeed(settings, colors);
        ASSERT_TRUE(need) << each.option;
        EXPECT_EQ(need->option, each.option);
        EXPECT_EQ(need->reason, onlySoftware(each.capability));
        Capabilities capable;
        capable.*each.capability = true;
        EXPECT_FALSE(missingCapability(settings, colors, capable)) << each.option;
        for (const Backend backend : {Backend::Auto, Backend::Software}) {
            settings.backend = backend;
            EXPECT_NO_THROW(requireCapable(settings, colors)) << each.option;
        }
        for (const Backend backend : {Backend::Osmesa, Backend::Egl, Backend::Window}) {
            settings.backend = backend;
            EXPECT_THROW(requireCapable(settings, colors), UsageError) << each.option;
        }
    }
}

TEST(BackendChoice, ABackendHasOneListOfCapabilities) {
    EXPECT_EQ(capabilitiesOf(Backend::Software), plan::kSoftwareCapabilities);
    for (const Backend backend : {Backend::Osmesa, Backend::Egl, Backend::Window})
        EXPECT_EQ(capabilitiesOf(backend), plan::kOpenGlCapabilities);
}

} // namespace
} // namespace gnomon::settings
