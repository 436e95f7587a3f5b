// Theory and set-up where chance rounds: a program of its own, in which each function of src/shadow, inlined or not,
// sets a rounding mode drawn from a seeded sequence where it begins and where it ends. An addition of vectors is a
// function.
#include "rounding_cases.h"

#include <gtest/gtest.h>

#include <cfenv>

namespace gnomon::shadow {
namespace {

struct Chance {
    std::uint64_t state = 0;
    std::uint64_t roundingsSet = 0;
    bool isRounding = false;
};

__attribute__((no_instrument_function)) Chance& chance() {
    static Chance ofTheProgram;
    return ofTheProgram;
}

__attribute__((no_instrument_function)) void roundByChance() {
    Chance& now = chance();
    if (!now.isRounding) return;
    now.state ^= now.state << 13U; // Marsaglia's xorshift
    now.state ^= now.state >> 7U;
    now.state ^= now.state << 17U;
    // No std::array: its functions would be counted, too.
    static const int kModes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}; // NOLINT(*-c-arrays)
    std::fesetround(kModes[now.state >> 62U]);
    ++now.roundingsSet;
}

class RandomRounding {
public:
    explicit RandomRounding(std::uint64_t seed) {
        chance().state = mix64(seed) | 1U;
        chance().isRounding = true;
    }

    ~RandomRounding() {
        chance().isRounding = false;
        std::fesetround(FE_TONEAREST);
    }

    RandomRounding(const RandomRounding&) = delete;
    RandomRounding& operator=(const RandomRounding&) = delete;
    RandomRounding(RandomRounding&&) = delete;
    RandomRounding& operator=(RandomRounding&&) = delete;
};

TEST(Rounding, ChanceChangesNoSetUpUnreported) {
    Random random(asked("GNOMON_ROUNDING_SEED", 1));
    RoundingCounts counts;
    counts.mayChangeLayout = true;
    // To come back to a view: those before it are drawn, and nothing is made of them.
    const std::uint64_t skipped = asked("GNOMON_ROUNDING_SKIPPED", 0);
    for (std::uint64_t view = 0; view < skipped; ++view)
        static_cast<void>(RoundedCase(random));
    const std::uint64_t asGiven = asked("GNOMON_ROUNDING_VIEWS", 1000);
    for (std::uint64_t i = asGiven - std::min(asGiven, skipped); i > 0 && !testing::Test::HasFailure(); --i) {
        SCOPED_TRACE(testing::Message() << "view " << asGiven - i << " of " << asGiven);
        expectSame<RandomRounding>(random, {i}, counts);
    }
    report(counts);
    EXPECT_GT(chance().roundingsSet, counts.views * 100);
}

} // namespace
} // namespace gnomon::shadow

// What the compiler calls, by its names.
// NOLINTBEGIN(readability-identifier-naming, bugprone-reserved-identifier)
extern "C" {
__attribute__((no_instrument_function)) void __cyg_profile_func_enter(void* /*function*/, void* /*caller*/) {
    gnomon::shadow::roundByChance();
}

__attribute__((no_instrument_function)) void __cyg_profile_func_exit(void* /*function*/, void* /*caller*/) {
    gnomon::shadow::roundByChance();
}
}
// NOLINTEND(readability-identifier-naming, bugprone-reserved-identifier)
