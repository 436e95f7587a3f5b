#include "tests/support/chance_rounding.h"

#include "core/random.h"

#include <array>
#include <cfenv>

namespace gnomon::tests {

namespace {

struct Chance {
    std::uint64_t state = 0;
    std::uint64_t roundingsSet = 0;
    bool isRounding = false;
};

Chance& chance() {
    static Chance ofTheProgram;
    return ofTheProgram;
}

void roundByChance() {
    Chance& now = chance();
    if (!now.isRounding) return;
    now.state ^= now.state << 13U; // Marsaglia's xorshift
    now.state ^= now.state >> 7U;
    now.state ^= now.state << 17U;
    constexpr std::array kModes = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    std::fesetround(kModes[now.state >> 62U]);
    ++now.roundingsSet;
}

} // namespace

ChanceRounding::ChanceRounding(std::uint64_t seed) {
    chance().state = mix64(seed) | 1U;
    chance().isRounding = true;
}

ChanceRounding::~ChanceRounding() {
    chance().isRounding = false;
    std::fesetround(FE_TONEAREST);
}

std::uint64_t ChanceRounding::count() {
    return chance().roundingsSet;
}

} // namespace gnomon::tests

// What the compiler calls, by its names.
// NOLINTBEGIN(readability-identifier-naming, bugprone-reserved-identifier)
extern "C" {
void __cyg_profile_func_enter(void* /*function*/, void* /*caller*/) {
    gnomon::tests::roundByChance();
}

void __cyg_profile_func_exit(void* /*function*/, void* /*caller*/) {
    gnomon::tests::roundByChance();
}
}
// NOLINTEND(readability-identifier-naming, bugprone-reserved-identifier)
