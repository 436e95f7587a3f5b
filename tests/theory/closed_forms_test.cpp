// Every closed form of src/shadow beside its twin of 200 bits, over its whole domain: how many units in the last place
// it is off, and where that is more than 64, whether the condition number of its inputs says so.
#include "tests/theory/ulps_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

namespace gnomon::theory {
namespace {

/// The most that a closed form may be off where the condition number of its inputs does not say more, in ulps.
constexpr double kMaxUlps = 64;

/// The condition number of output `index` at `in`: how much more it changes, relatively, than inputs do that change
/// by 2^-53, all at once in the worst way. So small a step is also what a kink or a jump nearby shows in.
double conditionOf(const ClosedForm& form, const Doubles& in, std::size_t index) {
    const Reals inputs(in.begin(), in.end());
    const Real at = form.exact(inputs)[index];
    Real sum = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (i >= form.wholeFrom || in[i] == 0 || !std::isfinite(in[i])) continue;
        Real max = 0;
        for (const double step : {-0x1p-53, 0x1p-53}) {
            Reals moved = inputs;
            moved[i] = moved[i] * (1 + Real(step));
            max = greater(max, magnitude(form.exact(moved)[index] - at));
        }
        sum += max;
    }
    return (sum / (magnitude(at) * 0x1p-53)).rounded();
}

/// The worst of one output over all samples.
struct Worst {
    double ulps = 0;
    double condition = 0;  // there, if it is asked for
    double share = 0;      // the largest part of what is allowed
    std::size_t above = 0; // samples of more than 64 ulps
    Doubles at;
};

std::string wordsOf(const Doubles& in) {
    std::string words;
    for (const double value : in) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.17g ", value);
        words += text.data();
    }
    return words;
}

void add(Worst& worst, const ClosedForm& form, const Doubles& in, std::size_t index, double ulps) {
    const double condition = ulps > kMaxUlps ? conditionOf(form, in, index) : 0;
    worst.above += ulps > kMaxUlps ? 1 : 0;
    worst.share = std::max(worst.share, ulps / std::max(kMaxUlps, condition));
    EXPECT_LE(ulps, std::max(kMaxUlps, condition)) << form.name << ": " << form.outputs[index] << " at " << wordsOf(in);
    if (ulps < worst.ulps) return;
    worst.ulps = ulps;
    worst.condition = condition;
    worst.at = in;
}

std::vector<Worst> worstOf(const ClosedForm& form, std::uint64_t seed, int samples) {
    std::vector<Worst> worst(form.outputs.size());
    Random random(seed);
    for (int i = 0; i < samples; ++i) {
        const Doubles in = form.draw(random);
        const Doubles ours = form.ours(in);
        const Reals exact = form.exact({in.begin(), in.end()});
        for (std::size_t j = 0; j < worst.size(); ++j)
            add(worst[j], form, in, j, ulpsOff(ours[j], exact[j]));
    }
    return worst;
}

/// As many as `GNOMON_TWIN_SAMPLES` says, and with it a table of the worst.
TEST(ClosedForms, AreWithin64UlpsOrTheirConditionNumberOfTheirTwins) {
    const char* asked = std::getenv("GNOMON_TWIN_SAMPLES");
    for (const ClosedForm& form : closedFormsWithTwins()) {
        const std::vector<Worst> worst = worstOf(form, 1, asked != nullptr ? std::atoi(asked) : 1500);
        for (std::size_t j = 0; asked != nullptr && j < worst.size(); ++j)
            std::cout << "| " << form.name << " | " << form.outputs[j] << " | " << worst[j].ulps << " | "
                      << worst[j].condition << " | " << worst[j].above << " | " << worst[j].share << " | "
                      << wordsOf(worst[j].at) << "|\n";
    }
}

/// What the map found, and what was mended then: units in the last place before, and why.
TEST(ClosedForms, KeepWhatWasMended) {
    struct Kept {
        std::string_view form;
        Doubles in;
        double max;
    };

    const std::vector<Kept> kKept = {
        // 3e9: differences of M_z, of which a depth ratio near 1 leaves nothing
        {"eta of n'", {1, 1.000001, 0.5, 1, 1.5}, 8},
        {"eta of n'", {1, 1.000001, 0.5, 1, 1e3}, 8},
        // 2e6: sqrt(f/n) - 1
        {"kappa of a fit", {1e-9, 1, 1, 1.0000000000000002}, 4},
        // 2,000: zeta of one far vertex as the difference of its z and that of another one
        {"any light",
         {365.4108371570278,
          79189994.545191631,
          1.5533430342749535,
          0.5,
          8.5489041825183691e-05,
          0.85281960933268752,
          -0.5222056171942866,
          9.5766008551155092e-06,
          1},
         64},
        // 1e10: ln(f/n) of a quotient near 1
        {"logarithmic sums", {1, 1.000001, 0.5, 1, 0.6, 0.8, 0}, 8},
    };
    for (const Kept& kept : kKept) {
        const std::vector<ClosedForm>& forms = closedFormsWithTwins();
        const auto form =
            std::find_if(forms.begin(), forms.end(), [&](const ClosedForm& f) { return f.name == kept.form; });
        ASSERT_NE(form, forms.end());
        const Doubles ours = form->ours(kept.in);
        const Reals exact = form->exact({kept.in.begin(), kept.in.end()});
        for (std::size_t j = 0; j < ours.size(); ++j)
            EXPECT_LE(ulpsOff(ours[j], exact[j]), kept.max) << kept.form << " at " << wordsOf(kept.in);
    }
}

} // namespace
} // namespace gnomon::theory
