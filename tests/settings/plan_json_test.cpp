// What `gnomon explain` prints, against the plan that it is of: points go where the matrices and planes say.
#include "core/random.h"
#include "plan/plan_frame.h"
#include "settings/plan_json.h"
#include "settings/plan_sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace gnomon::settings {
namespace {

using nlohmann::ordered_json;

/// A plan over a ground of boxes, anywhere in the world.
plan::FramePlan anyPlan(Random& random) {
    const glm::dvec3 origin(random.uniform(-1e4, 1e4), random.uniform(-100, 100), random.uniform(-1e4, 1e4));
    plan::View view;
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    view.camera = {
        origin + glm::dvec3(30 * std::cos(angle), random.uniform(1, 15), 30 * std::sin(angle)),
        origin,
        {0, 1, 0},
        random.uniform(0.5, 1.5)};
    view.width = 400 + static_cast<int>(random.below(400));
    view.height = 400 + static_cast<int>(random.below(400));
    view.towardsLight = {random.uniform(-1, 1), random.uniform(0.2, 1), random.uniform(-1, 1)};
    plan::Quality quality;
    quality.zPartitions = 1 + static_cast<int>(random.below(4));
    if (random.below(3) == 0) quality.facePartitions = plan::Choice::On;
    if (random.below(8) == 0) quality.shadows = plan::ShadowMode::Off;
    plan::SceneFacts facts;
    facts.bounds = {origin - glm::dvec3(10, 2, 10), origin + glm::dvec3(10, 2, 10)};
    facts.visible = plan::SceneFacts::Visible{random.uniform(5, 18), random.uniform(40, 60), true};
    return plan::planFrame(view, quality, facts).plan;
}

/// `point` times the row-major matrix `numbers`, divided by w.
glm::dvec3 transformed(const ordered_json& numbers, const glm::dvec3& point) {
    std::array<double, 4> result{};
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const double factor = column < 3 ? point[static_cast<int>(column)] : 1.0;
            result[row] += numbers[4 * row + column].get<double>() * factor;
        }
    return glm::dvec3(result[0], result[1], result[2]) / result[3];
}

/// A point of the slice that `pass` is for, in world space; or elsewhere in the view.
glm::dvec3 anyVisiblePoint(Random& random, const plan::FramePlan& plan, double near, double far) {
    const double depth = random.uniform(near, far);
    const glm::dvec3 inCamera(
        random.uniform(-1, 1) * depth * plan.view.tanHalfX(),
        random.uniform(-1, 1) * depth * plan.view.tanHalfY(),
        depth);
    return plan.view.camera.eye + toWorld(plan.basis, inCamera);
}

/// Calls `look(plan, what is printed of it)` for 60 plans.
template <class Look>
void forPlans(Random& random, const Look& look) {
    for (int trial = 0; trial < 60; ++trial) {
        const plan::FramePlan plan = anyPlan(random);
        look(plan, planJson(plan, {Backend::Software, "a reason"}));
    }
}

TEST(PlanJson, HasEveryFieldOfTheContract) {
    Random random(1);
    forPlans(random, [&](const plan::FramePlan& plan, const ordered_json& json) {
        EXPECT_EQ(json["near"], plan.near);
        EXPECT_EQ(json["far"], plan.far);
        EXPECT_EQ(json["near_from"], sourceInWords(plan.nearFrom));
        EXPECT_EQ(json["far_from"], sourceInWords(plan.farFrom));
        EXPECT_NEAR(json["light_angle"].get<double>(), plan.lightAngleRadians * 180 / std::numbers::pi, 1e-9);
        EXPECT_EQ(json["promise_kept"], plan.isBoundKept);
        EXPECT_EQ(json["scheme"], plan::schemeName(plan));
        EXPECT_EQ(json["cost"], plan.cost);
        EXPECT_EQ(json["texels_that_would_do"].is_null(), plan.requiredTexels == 0);
        ASSERT_EQ(json["omitted"].size(), plan.omitted.size());
        for (std::size_t i = 0; i < plan.omitted.size(); ++i)
            EXPECT_EQ(
                json["omitted"][i],
                (ordered_json{{"effect", effectInWords(plan.omitted[i])}, {"reason", reasonInWords(plan.omitted[i])}}));
        ASSERT_EQ(json["passes"].size(), plan.passes.size());
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            const ordered_json& told = json["passes"][i];
            const shadow::ShadowMap& map = plan.passes[i].map;
            EXPECT_EQ(told["kind"], "shadow_map");
            EXPECT_EQ(told["slice"], map.region.slice);
            EXPECT_EQ(told["face"], shadow::name(map.region.face));
            EXPECT_EQ(told["near"], map.region.frustum.near);
            EXPECT_EQ(told["far"], map.region.frustum.far);
            EXPECT_EQ(
                told["rectangle"],
                (ordered_json{map.rectangle.x, map.rectangle.y, map.rectangle.width, map.rectangle.height}));
            EXPECT_EQ(told["kappa"], map.warped.kappa);
            EXPECT_EQ(told["promised_aliasing_x"], map.aliasingBound.x);
            EXPECT_EQ(told["promised_aliasing_z"], map.aliasingBound.z);
            EXPECT_EQ(told["promised_aliasing_z_sheared"], map.aliasingBound.sheared);
            EXPECT_GE(map.aliasingBound.sheared, map.aliasingBound.z * (1 - 1e-12));
            EXPECT_EQ(told["covered_near"], map.region.covered.near);
            EXPECT_EQ(told["covered_far"], map.region.covered.far);
            EXPECT_EQ(told["light_clip_from_world"].size(), 16U);
            EXPECT_EQ(told["caster_planes"].size(), map.casterVolume.planes.size());
        }
    });
}

TEST(PlanJson, PutsWhatASliceSeesIntoTheClipSpaceOfItsMap) {
    Random random(2);
    int points = 0;
    forPlans(random, [&](const plan::FramePlan& plan, const ordered_json& json) {
        for (const ordered_json& pass : json["passes"]) {
            if (pass["face"] != "whole") continue; // of a face only a part of the view
            for (int i = 0; i < 20; ++i) {
                const glm::dvec3 world =
                    anyVisiblePoint(random, plan, pass["near"].get<double>(), pass["far"].get<double>());
                const glm::dvec3 clip = transformed(pass["light_clip_from_world"], world);
                constexpr double kRounding = 1e-6;
                EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), 1 + kRounding) << clip.x << " " << clip.y;
                ++points;
            }
        }
    });
    EXPECT_GT(points, 500);
}

TEST(PlanJson, CountsDepthFromTheLightFromMinusOneToOne) {
    Random random(3);
    int compared = 0;
    forPlans(random, [&](const plan::FramePlan& plan, const ordered_json& json) {
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            const glm::dvec3 world = anyVisiblePoint(random, plan, plan.near, plan.far);
            const glm::dvec4 inCamera(toCamera(plan.basis, world - plan.view.camera.eye), 1);
            const glm::dvec4 own = plan.passes[i].map.lightClipFromCamera() * inCamera;
            const glm::dvec3 told = transformed(json["passes"][i]["light_clip_from_world"], world);
            const double scale = 1 + std::abs(own.x / own.w) + std::abs(own.y / own.w) + std::abs(own.z / own.w);
            EXPECT_NEAR(told.x, own.x / own.w, 1e-6 * scale);
            EXPECT_NEAR(told.y, own.y / own.w, 1e-6 * scale);
            EXPECT_NEAR(told.z, 2 * own.z / own.w - 1, 1e-6 * scale);
            ++compared;
        }
    });
    EXPECT_GT(compared, 50);
}

TEST(PlanJson, HasPlanesThatHoldWhatTheCastersVolumeHolds) {
    Random random(4);
    int inside = 0;
    int outside = 0;
    forPlans(random, [&](const plan::FramePlan& plan, const ordered_json& json) {
        for (std::size_t i = 0; i < plan.passes.size(); ++i)
            for (int point = 0; point < 20; ++point) {
                const glm::dvec3 world = anyVisiblePoint(random, plan, 0.1, 3 * plan.far);
                const glm::dvec3 inCamera = toCamera(plan.basis, world - plan.view.camera.eye);
                double own = 1e300;
                for (const Plane& plane : plan.passes[i].map.casterVolume.planes)
                    own = std::min(own, plane.signedDistance(inCamera));
                double told = 1e300;
                for (const ordered_json& plane : json["passes"][i]["caster_planes"])
                    told = std::min(
                        told,
                        plane[0].get<double>() * world.x + plane[1].get<double>() * world.y +
                            plane[2].get<double>() * world.z + plane[3].get<double>());
                EXPECT_NEAR(told, own, 1e-6 * (1 + std::abs(own)));
                (own >= 0 ? inside : outside) += 1;
            }
    });
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 100);
}

TEST(PlanText, HasALineForEachMapAndEachOmission) {
    Random random(5);
    for (int trial = 0; trial < 60; ++trial) {
        const plan::FramePlan plan = anyPlan(random);
        const std::string text = planText(plan, {Backend::Software, "a reason"});
        std::istringstream lines(text);
        std::string line;
        std::size_t maps = 0;
        std::size_t omitted = 0;
        bool isSkipped = false;
        while (std::getline(lines, line)) {
            EXPECT_LT(line.size(), 300U);
            const bool isMap = !line.empty() && line.front() >= '0' && line.front() <= '9';
            maps += isMap ? 1 : 0;
            omitted += isSkipped ? 1 : 0;
            isSkipped = isSkipped || line == "left out";
        }
        EXPECT_EQ(maps, plan.passes.size()) << text;
        EXPECT_EQ(omitted, plan.omitted.size()) << text;
        for (const plan::SkippedEffect& skipped : plan.omitted)
            EXPECT_NE(text.find(reasonInWords(skipped)), std::string::npos) << text;
        EXPECT_NE(text.find(sourceInWords(plan.nearFrom)), std::string::npos);
        EXPECT_EQ(text.find("aliasing bound x") != std::string::npos, !plan.passes.empty());
    }
}

TEST(PlanText, SaysWhereAPromiseIsNotKept) {
    Random random(6);
    plan::FramePlan plan = anyPlan(random);
    while (plan.passes.empty())
        plan = anyPlan(random);
    plan.isBoundKept = true;
    plan.requiredTexels = 123456;
    EXPECT_EQ(planText(plan, {Backend::Software, "a reason"}).find("NOT"), std::string::npos);
    EXPECT_NE(
        planText(plan, {Backend::Software, "a reason"}).find("; 123456 texels would suffice for 4\n"),
        std::string::npos)
        << planText(plan, {Backend::Software, "a reason"});
    plan.isBoundKept = false;
    plan.requiredTexels = 0;
    EXPECT_NE(
        planText(plan, {Backend::Software, "a reason"}).find("which is NOT what was requested"), std::string::npos);
    EXPECT_NE(
        planText(plan, {Backend::Software, "a reason"}).find("; no number of texels would suffice for 4\n"),
        std::string::npos)
        << planText(plan, {Backend::Software, "a reason"});
    EXPECT_TRUE(planJson(plan, {Backend::Software, "a reason"})["texels_that_would_do"].is_null());
}

} // namespace
} // namespace gnomon::settings
