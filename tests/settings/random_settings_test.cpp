// Settings at random: texts read back as the values that they were, axes combine, steps stay legal, nothing is resolved
// that contradicts itself.
#include "core/random.h"
#include "settings/axes.h"
#include "settings/limits.h"
#include "settings/resolve.h"
#include "settings/step.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace gnomon::settings {
namespace {

/// Any finite number: of any bits, of any size, or short.
double anyNumberOf(Random& random) {
    switch (random.below(3)) {
    case 0: {
        const std::uint64_t bits = random.bits();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return std::isfinite(value) ? value : 0;
    }
    case 1:
        return random.uniform(-1, 1) * std::pow(10, random.uniform(-20, 20));
    default:
        return static_cast<double>(random.below(2000)) / 8 - 100;
    }
}

TEST(RandomText, OfAnyFiniteNumberReadsBackToTheSameBits) {
    Random random(1);
    const Codec<double> codec = anyNumber();
    for (int i = 0; i < 20000; ++i) {
        const double value = anyNumberOf(random);
        const std::string text = codec.write(value);
        EXPECT_EQ(codec.read(text), std::optional(value)) << text;
        EXPECT_EQ(codec.read("+" + text).has_value(), !text.starts_with("+")) << text;
        EXPECT_FALSE(codec.read(text + " ") || codec.read(" " + text) || codec.read(text + "e")) << text;
    }
}

TEST(RandomText, OfAVectorReadsBackAndHasThreeParts) {
    Random random(2);
    for (int i = 0; i < 3000; ++i) {
        glm::dvec3 value;
        for (int axis = 0; axis < 3; ++axis)
            value[axis] = anyNumberOf(random);
        const std::string text = vector().write(value);
        EXPECT_EQ(vector().read(text), std::optional(value)) << text;
        EXPECT_FALSE(vector().read(text + ",0") || vector().read(text.substr(0, text.rfind(',')))) << text;
        const double length = glm::length(value);
        EXPECT_EQ(direction().read(text).has_value(), length > 0 && std::isfinite(length)) << text;
    }
}

TEST(RandomText, OfCountsAndMemoryIsShortAndReadsBack) {
    Random random(3);
    for (int i = 0; i < 5000; ++i) {
        std::uint64_t number = 1 + (random.bits() >> (13 + random.below(50)));
        const std::uint64_t zeros = random.below(4);
        std::uint64_t binary = number & 0xFFFFFFFFULL;
        if (binary == 0) binary = 1;
        for (std::uint64_t k = 0; k < zeros; ++k) {
            number = number < std::uint64_t{1} << 40U ? number * 1000 : number;
            binary = binary < std::uint64_t{1} << 40U ? binary * 1024 : binary;
        }
        const std::string counted = count().write(number);
        EXPECT_EQ(count().read(counted), std::optional(number)) << counted;
        EXPECT_LE(counted.size(), std::to_string(number).size());
        const std::string sized = memory().write({binary});
        EXPECT_EQ(memory().read(sized), std::optional(Bytes{binary})) << sized;
        EXPECT_LE(sized.size(), std::to_string(binary).size());
    }
}

TEST(RandomText, OfASizeReadsBackExactlyWhereItIsAllowed) {
    Random random(4);
    const auto small = size("few", [](const std::array<int, 2>& value) { return value[0] + value[1] <= 50; });
    for (int i = 0; i < 3000; ++i) {
        const std::array value = {static_cast<int>(random.below(60)) - 5, static_cast<int>(random.below(60)) - 5};
        const std::string text = small.write(value);
        const bool isAllowed = value[0] >= 1 && value[1] >= 1 && value[0] + value[1] <= 50;
        EXPECT_EQ(small.read(text), isAllowed ? std::optional(value) : std::nullopt) << text;
    }
}

TEST(RandomText, OfAListIsCutAtEveryComma) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        std::string list;
        bool hasEmpty = false;
        std::vector<std::string> items;
        const auto parts = 1 + random.below(5);
        for (std::uint64_t part = 0; part < parts; ++part) {
            const std::string item(random.below(4), static_cast<char>('a' + random.below(26)));
            hasEmpty = hasEmpty || item.empty();
            items.push_back(item);
            list += (part > 0 ? "," : "") + item;
        }
        if (hasEmpty) {
            EXPECT_THROW(listItems("--list", list), UsageError) << list;
        } else {
            EXPECT_EQ(listItems("--list", list), items) << list;
        }
    }
}

/// Two to four of the texts that each swept setting may have.
std::vector<std::string> textsOf(const Setting& setting) {
    if (setting.kind() == Kind::Switch || setting.kind() == Kind::Words) return setting.words();
    if (setting.kind() == Kind::Size) return {"256x256", "512x256", "2048x2048"};
    if (setting.kind() == Kind::WholeOrAuto) return {"auto", "1", "3", "12"};
    if (setting.kind() == Kind::Whole) return {"0", "2", "5"};
    return {"0.5", "1", "2", "64"};
}

std::vector<const Setting*> sweptSettings() {
    std::vector<const Setting*> swept;
    for (const Setting& each : table())
        if (each.description().isSwept) swept.push_back(&each);
    return swept;
}

/// Settings whose swept rows have any of their texts.
Settings anySettings(Random& random) {
    Settings settings;
    for (const Setting* each : sweptSettings()) {
        if (random.below(2) == 0) continue;
        const std::vector<std::string> texts = textsOf(*each);
        each->set(settings, each->parse(texts[random.below(texts.size())]));
    }
    return settings;
}

/// Some values of `setting` as a list: at least the first.
std::string anyList(Random& random, const Setting& setting) {
    std::string list;
    for (const std::string& text : textsOf(setting))
        if (list.empty() || random.below(2) == 0) list.append(list.empty() ? "" : ",").append(text);
    return list;
}

// The nested loops that a person would write, one for each axis, beside the product that grows axis by axis.
TEST(RandomAxes, CombineLikeTheDigitsOfANumber) {
    Random random(6);
    const std::vector<const Setting*> swept = sweptSettings();
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Axis> axes;
        std::size_t runs = 1;
        for (const Setting* each : swept) {
            if (random.below(3) != 0 || runs > 200) continue;
            axes.push_back(parseAxis(*each, each->option(), anyList(random, *each)));
            runs *= axes.back().values.size();
        }
        const std::vector<Settings> all = combinations(Settings(), axes);
        ASSERT_EQ(all.size(), runs);
        for (std::size_t run = 0; run < runs; ++run) {
            std::size_t rest = run;
            for (std::size_t axis = axes.size(); axis-- > 0;) {
                const std::size_t digit = rest % axes[axis].values.size();
                rest /= axes[axis].values.size();
                const Setting& setting = *axes[axis].setting;
                EXPECT_EQ(setting.text(all[run]), setting.text(axes[axis].values[digit])) << setting.name();
            }
        }
    }
}

TEST(RandomAxes, WithAValueTwiceAreRefusedHoweverItIsWritten) {
    const auto refused = [](const char* name, const char* list) {
        try {
            parseAxis(named(name), "--sweep", list);
            return std::string();
        } catch (const UsageError& error) {
            return error.message;
        }
    };
    EXPECT_EQ(refused("filter", "2,3,+2"), "--sweep: expected each value once, found '2,3,+2'");
    EXPECT_EQ(refused("error-pixels", "0.5,1,5e-1"), "--sweep: expected each value once, found '0.5,1,5e-1'");
    EXPECT_EQ(refused("warp", "none,none"), "--sweep: expected each value once, found 'none,none'");
    EXPECT_EQ(refused("warp", "none,auto"), "");
    EXPECT_EQ(refused("filter", "2,x"), "--sweep: expected a whole number from 0 to 16, found 'x'");
}

TEST(RandomSettings, AreAlikeExactlyWhereAllSweptTextsAre) {
    Random random(7);
    int alike = 0;
    for (int i = 0; i < 500; ++i) {
        const Settings a = anySettings(random);
        Settings b = random.below(2) == 0 ? a : anySettings(random);
        b.cameraFile = "another view";
        b.memory = gibibytes(7);
        bool areSame = true;
        for (const Setting* each : sweptSettings())
            areSame = areSame && each->text(a) == each->text(b);
        EXPECT_EQ(areAlike(a, b), areSame);
        alike += areSame ? 1 : 0;
    }
    EXPECT_GT(alike, 100);
    EXPECT_LT(alike, 400);
}

TEST(RandomSettings, ArePastedAsOptionsThatMakeThemAgain) {
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const Settings settings = anySettings(random);
        const std::string options = optionsToPaste(settings, true);
        Settings again;
        std::set<std::string> given;
        for (std::size_t at = 0; at < options.size();) { // no value of these has a space
            const std::size_t name = at + 2;
            const std::size_t nameEnd = options.find(' ', name);
            const std::size_t end = std::min(options.find(' ', nameEnd + 1), options.size());
            const Setting& setting = named(options.substr(name, nameEnd - name));
            setting.set(again, setting.parse(options.substr(nameEnd + 1, end - nameEnd - 1)));
            EXPECT_TRUE(given.insert(setting.name()).second) << options;
            at = end + 1;
        }
        for (const Setting* each : sweptSettings()) {
            EXPECT_EQ(given.contains(each->name()), !each->isDefault(settings) && appliesTo(*each, settings))
                << options;
            if (!appliesTo(*each, settings)) continue;
            EXPECT_EQ(each->text(again), each->text(settings)) << options;
        }
    }
}

TEST(RandomSteps, LeadToNothingThatTheOptionWouldRefuse) {
    Random random(9);
    Settings settings;
    const std::vector<const Setting*> swept = sweptSettings();
    for (int i = 0; i < 3000; ++i) {
        const Setting& setting = *swept[random.below(swept.size())];
        if (setting.description().offer.title.empty()) continue;
        const int steps = static_cast<int>(random.below(9)) - 4;
        step(setting, settings, steps);
        const std::string text = setting.text(settings);
        EXPECT_NO_THROW(setting.parse(text)) << setting.name() << " " << text;
        EXPECT_EQ(inWords(setting, settings).find(setting.description().offer.title + ": "), 0U);
    }
}

TEST(RandomSteps, OfWordsComeBackTheWayTheyWent) {
    Random random(10);
    for (const Setting* each : sweptSettings()) {
        if (each->kind() != Kind::Words && each->kind() != Kind::Switch) continue;
        for (int i = 0; i < 50; ++i) {
            Settings settings;
            each->set(settings, each->parse(each->words()[random.below(each->words().size())]));
            const std::string before = each->text(settings);
            const int steps = 1 + static_cast<int>(random.below(20));
            step(*each, settings, steps);
            step(*each, settings, -steps);
            EXPECT_EQ(each->text(settings), before) << each->name();
        }
    }
}

} // namespace
} // namespace gnomon::settings
