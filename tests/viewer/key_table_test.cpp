// The table of keys is whole: no key twice, nothing without help, nothing out of reach.
#include "settings/table.h"
#include "viewer/input/camera_control.h"
#include "viewer/input/key_table.h"
#include "viewer/input/setting_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace gnomon::viewer {
namespace {

TEST(KeyTable, NoKeyIsThereTwiceAndEachHasHelp) {
    std::set<std::pair<int, bool>> keys;
    std::set<std::string> names;
    for (const Binding& binding : bindings()) {
        EXPECT_TRUE(keys.insert({binding.key, binding.withShift}).second) << binding.keyName;
        EXPECT_TRUE(names.insert(binding.keyName).second) << binding.keyName;
        EXPECT_NE(std::string(binding.help), "") << binding.keyName;
    }
}

TEST(KeyTable, EveryActionHasAKey) {
    std::set<Action> found;
    for (const Binding& binding : bindings())
        found.insert(binding.action);
    EXPECT_EQ(found.size(), static_cast<std::size_t>(Action::Leave) + 1);
}

TEST(KeyTable, EveryOverlaySideAndWayHasAKey) {
    std::set<int> overlays;
    std::set<int> sides;
    std::set<int> ways;
    for (const Binding& binding : bindings()) {
        if (binding.action == Action::SetOverlay) overlays.insert(binding.value);
        if (binding.action == Action::LookFrom) sides.insert(binding.value);
        if (binding.action == Action::Fly) ways.insert(binding.value);
    }
    const std::size_t withKeys = std::min<std::size_t>(render::kOverlays.size(), 8); // F9 opens the model again
    EXPECT_EQ(overlays.size(), withKeys);
    EXPECT_EQ(*overlays.rbegin(), static_cast<int>(withKeys) - 1);
    EXPECT_EQ(sides.size(), static_cast<std::size_t>(path::ViewSide::Bottom) + 1);
    EXPECT_EQ(ways.size(), static_cast<std::size_t>(Way::Up) + 1);
}

TEST(KeyTable, AKeyChangesTheSettingThatItNamesWhichThePanelOffersToo) {
    for (const Binding& binding : bindings()) {
        if (binding.action != Action::StepSetting) continue;
        settings::Settings settings;
        const settings::Setting& setting = settings::named(binding.setting);
        const std::optional<std::string> said = changeQuality(binding, settings);
        EXPECT_FALSE(setting.isDefault(settings)) << binding.keyName;
        EXPECT_EQ(said.value_or("").rfind(setting.description().offer.title + ": ", 0), 0U) << binding.keyName;
        EXPECT_NE(setting.description().offer.title, "") << binding.keyName;
    }
}

TEST(KeyTable, ShiftCountsOnlyWhereItIsNamed) {
    EXPECT_EQ(bindingOf(GLFW_KEY_W, true), bindingOf(GLFW_KEY_W, false)); // Shift hastens
    EXPECT_NE(bindingOf(GLFW_KEY_T, true), bindingOf(GLFW_KEY_T, false));
    EXPECT_EQ(bindingOf(GLFW_KEY_PAUSE, false), nullptr);
}

TEST(KeyTable, ALevelSectionComesMovesAndGoes) {
    const Box bounds{{-1, 2, 0}, {1, 10, 4}};
    settings::Settings settings;
    const auto press = [&](Action action, int value) {
        return changeSection({.action = action, .value = value}, settings, bounds, {0, 2, 0});
    };
    EXPECT_FALSE(press(Action::Focus, 1));
    EXPECT_EQ(press(Action::ToggleSection, 0), "section: 4 above the lowest point");
    EXPECT_EQ(settings.sections, (std::vector<settings::Section>{{{0, 6, 2}, {0, 1, 0}}}));
    EXPECT_EQ(press(Action::MoveSection, 50), "section: 5 above the lowest point");
    EXPECT_EQ(press(Action::ToggleSection, 0), "section: none");
    EXPECT_TRUE(settings.sections.empty());
    EXPECT_EQ(press(Action::MoveSection, -50), "section: 3 above the lowest point");
    EXPECT_TRUE(press(Action::ToggleSection, 0) && press(Action::ToggleSection, 1));
    ASSERT_EQ(settings.sections.size(), settings::kMaxSections);
    const double top = bounds.max.y;
    EXPECT_TRUE(press(Action::MoveSection, -100)); // of a box its lid
    EXPECT_EQ(settings.sections.back().normal, glm::dvec3(0, 1, 0));
    EXPECT_LT(settings.sections.back().point.y, top - 1.9);
}

} // namespace
} // namespace gnomon::viewer
