// One setting of any type: what it is called, what kind of value it has, how it is read, written, found and changed.
#include "settings/setting.h"
#include "settings/settings.h"
#include "settings/usage_error.h"

#include <gtest/gtest.h>

#include <memory>

namespace gnomon::settings {
namespace {

/// A setting whose value stands beside all settings.
template <class T>
Setting madeOf(const Codec<T>& codec, const std::string& form = "") {
    const auto place = std::make_shared<T>();
    return {
        {.name = "two-words", .form = form, .help = "Helps"},
        codec,
        [place](const Settings&) { return *place; },
        [place](Settings&, const T& value) { *place = value; }};
}

TEST(Setting, IsCalledByItsNameEverywhere) {
    const Setting setting = madeOf(text(), "TEXT");
    EXPECT_EQ(setting.name(), "two-words");
    EXPECT_EQ(setting.option(), "--two-words");
    EXPECT_EQ(setting.column(), "two_words");
    EXPECT_EQ(setting.description().help, "Helps");
    EXPECT_EQ(setting.description().form, "TEXT");
}

TEST(Setting, KnowsTheKindOfItsValueByItsCodec) {
    EXPECT_EQ(madeOf(onOff()).kind(), Kind::Switch);
    EXPECT_EQ(madeOf(oneOf(kBackends)).kind(), Kind::Words);
    EXPECT_EQ(madeOf(whole(0, 9)).kind(), Kind::Whole);
    EXPECT_EQ(madeOf(orAuto(whole(0, 9))).kind(), Kind::WholeOrAuto);
    EXPECT_EQ(madeOf(anyNumber()).kind(), Kind::Number);
    EXPECT_EQ(madeOf(size("any", [](const auto&) { return true; })).kind(), Kind::Size);
    EXPECT_EQ(madeOf(vector()).kind(), Kind::Other);
    EXPECT_EQ(madeOf(text()).kind(), Kind::Other);
}

TEST(Setting, OfWordsHasThemForItsForm) {
    const Setting setting = madeOf(oneOf(kBackends));
    EXPECT_EQ(setting.words(), (std::vector<std::string>{"auto", "software", "osmesa", "egl", "window"}));
    EXPECT_EQ(setting.description().form, "auto|software|osmesa|egl|window");
    EXPECT_EQ(madeOf(oneOf(kBackends), "EXECUTOR").description().form, "EXECUTOR");
}

TEST(Setting, IsReadWrittenFoundAndChanged) {
    const Setting setting = madeOf(whole(0, 9));
    Settings settings;
    EXPECT_EQ(setting.text(settings), "0");
    const Value seven = setting.parse("7");
    EXPECT_EQ(setting.text(seven), "7");
    setting.set(settings, seven);
    EXPECT_EQ(setting.text(settings), "7");
    EXPECT_EQ(std::any_cast<int>(setting.value(settings)), 7);
    try {
        setting.parse("--another", "10");
        ADD_FAILURE() << "it is out of range";
    } catch (const UsageError& error) {
        EXPECT_NE(error.message.find("--another"), std::string::npos) << error.message;
        EXPECT_NE(error.message.find("found '10'"), std::string::npos) << error.message;
    }
    EXPECT_THROW(setting.parse("x"), UsageError);
}

} // namespace
} // namespace gnomon::settings
