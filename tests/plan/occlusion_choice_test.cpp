// When an image is drawn without what it hides, and what is said where it is not.
#include "plan/occlusion_choice.h"

#include <gtest/gtest.h>

namespace gnomon::plan {
namespace {

FramePlan chosen(Choice occlusion, double layers, bool canSkip) {
    FramePlan plan;
    plan.quality.occlusion = occlusion;
    plan.backend.occlusionCulling = canSkip;
    chooseOcclusion(plan, layers);
    return plan;
}

std::vector<SkippedEffect> omitted(SkipReason reason) {
    return {{Effect::OcclusionCulling, reason}};
}

TEST(OcclusionChoice, OnIsOnWhateverTheLayersAndAutoCountsThem) {
    EXPECT_TRUE(chosen(Choice::On, 0, true).skipsHidden);
    EXPECT_TRUE(chosen(Choice::On, 0, true).omitted.empty());
    EXPECT_TRUE(chosen(Choice::Auto, kMinLayers, true).skipsHidden);
    EXPECT_TRUE(chosen(Choice::Auto, kMinLayers, true).omitted.empty());
}

TEST(OcclusionChoice, SaysWhyNot) {
    for (const bool canSkip : {false, true}) {
        EXPECT_FALSE(chosen(Choice::Off, 100, canSkip).skipsHidden);
        EXPECT_EQ(chosen(Choice::Off, 100, canSkip).omitted, omitted(SkipReason::SwitchedOff));
    }
    for (const Choice choice : {Choice::Auto, Choice::On}) {
        EXPECT_FALSE(chosen(choice, 100, false).skipsHidden);
        EXPECT_EQ(chosen(choice, 100, false).omitted, omitted(SkipReason::BackendDrawsAll));
    }
    EXPECT_FALSE(chosen(Choice::Auto, 0.99 * kMinLayers, true).skipsHidden);
    EXPECT_EQ(chosen(Choice::Auto, 0.99 * kMinLayers, true).omitted, omitted(SkipReason::FewLayers));
}

} // namespace
} // namespace gnomon::plan
