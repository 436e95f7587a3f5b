// The time target against machines whose frame time is a known function of what is drawn.
#include "core/random.h"
#include "viewer/detail_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gnomon::viewer {
namespace {

using Machine = std::function<double(const Effort&)>;

/// Frame time falls with the error, and with each slice.
Machine machine(double constantMs, double detailMs, double sliceMs) {
    return [=](const Effort& effort) {
        return constantMs + detailMs / effort.errorPixels + sliceMs * effort.slices.value_or(4);
    };
}

TEST(DetailBudget, GivesUpNothingWhereThereIsTime) {
    DetailBudget budget;
    const Effort wanted{1, 4};
    for (int i = 0; i < 100; ++i)
        budget.measure(10, 33);
    EXPECT_EQ(budget.effort(wanted), wanted);
    EXPECT_EQ(budget.givenUp(wanted), "");
}

TEST(DetailBudget, HoldsTheTargetOnMachinesOfAllKindsAndSwingsOnNone) {
    Random random(1);
    for (int kind = 0; kind < 100; ++kind) {
        const double target = random.uniform(10, 100);
        const double constant = random.uniform(0.05, 0.5) * target;
        const double detail = random.uniform(0.5, 8) * target;
        const Machine frameMs = machine(constant, detail, random.uniform(0.01, 0.1) * target);
        const Effort wanted{1, 8};
        DetailBudget budget;
        for (int i = 0; i < 300; ++i)
            budget.measure(frameMs(budget.effort(wanted)), target);
        ASSERT_FALSE(budget.isExhausted());
        int changes = 0;
        Effort last = budget.effort(wanted);
        for (int i = 0; i < 200; ++i) {
            const double noise = random.uniform(0.95, 1.05);
            budget.measure(frameMs(budget.effort(wanted)) * noise, target);
            const Effort now = budget.effort(wanted);
            changes += now.slices != last.slices ? 1 : 0;
            last = now;
        }
        EXPECT_LE(frameMs(last), target * 1.2) << kind;
        EXPECT_GE(frameMs(last), target * 0.7) << kind;
        EXPECT_LE(changes, 1) << kind;
    }
}

TEST(DetailBudget, ChangesNoMoreThanAQuarterOctaveAFrame) {
    DetailBudget budget;
    const Effort wanted{1, 4};
    double last = 1;
    for (int i = 0; i < 40; ++i) {
        budget.measure(i < 20 ? 5000 : 0.01, 33);
        const Effort now = budget.effort(wanted);
        EXPECT_LE(std::abs(std::log2(now.errorPixels / last)), 0.25 + 1e-12);
        last = now.errorPixels;
    }
}

TEST(DetailBudget, TakesEverythingBackWhenThereIsTime) {
    DetailBudget budget;
    const Effort wanted{0.5, 6};
    for (int i = 0; i < 100; ++i)
        budget.measure(500, 33);
    EXPECT_TRUE(budget.isExhausted());
    EXPECT_EQ(budget.effort(wanted).slices, 1);
    EXPECT_NE(budget.givenUp(wanted).find("slices 6 -> 1"), std::string::npos) << budget.givenUp(wanted);
    EXPECT_NE(budget.givenUp(wanted).find("detail 0.5 -> 16 px"), std::string::npos) << budget.givenUp(wanted);
    for (int i = 0; i < 200; ++i)
        budget.measure(1, 33);
    EXPECT_EQ(budget.effort(wanted), wanted);
}

TEST(DetailBudget, LeavesTheNumberOfSlicesToThePlanWhereItIsAuto) {
    DetailBudget budget;
    for (int i = 0; i < 100; ++i)
        budget.measure(500, 33);
    EXPECT_EQ(budget.effort({1, std::nullopt}).slices, std::nullopt);
}

} // namespace
} // namespace gnomon::viewer
