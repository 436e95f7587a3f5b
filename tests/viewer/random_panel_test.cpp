// What the window shows, at random against slow twins: messages, medians, what a load is called, wire frames of plans,
// the pad of lights, the help of the keys.
#include "core/random.h"
#include "core/units.h"
#include "plan/plan_frame.h"
#include "settings/step.h"
#include "settings/table.h"
#include "viewer/input/setting_keys.h"
#include "viewer/messages.h"
#include "viewer/panel/frame_history.h"
#include "viewer/panel/plan_words.h"
#include "viewer/panel/texel_plot.h"
#include "viewer/panel/wire_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace gnomon::viewer {
namespace {

/// The messages as a list in which everything is looked for from its beginning.
struct PlainMessages {
    enum class Kind { Shown, Note, Failure };

    struct Entry {
        std::string text;
        Kind kind;
        double until;
    };

    std::vector<Entry> all;

    void add(Kind kind, const std::string& text, double now) {
        const double seconds = kind == Kind::Shown ? 2 : kind == Kind::Note ? 6 : 15;
        if (kind == Kind::Failure)
            for (Entry& entry : all)
                if (entry.kind == kind && entry.text == text) {
                    entry.until = now + seconds;
                    return;
                }
        if (kind == Kind::Shown && !all.empty() && all.back().kind == kind) all.pop_back();
        all.push_back({text, kind, now + seconds});
    }

    bool expire(double now) {
        return std::erase_if(all, [&](const Entry& entry) { return entry.until <= now; }) > 0;
    }
};

TEST(RandomMessages, AreThoseOfAPlainListAndAreToldOnce) {
    using Kind = PlainMessages::Kind;
    Random random(1);
    double now = 0;
    std::vector<std::string> heard;
    Messages messages([&] { return now; }, [&](const std::string& text) { heard.push_back(text); });
    PlainMessages plain;
    std::vector<std::string> told;
    for (int step = 0; step < 3000; ++step) {
        now += random.below(3) == 0 ? random.uniform(0, 5) : 0;
        const std::string text = "message " + std::to_string(random.below(4));
        const std::size_t before = plain.all.size();
        switch (random.below(4)) {
        case 0:
            messages.show(text);
            plain.add(Kind::Shown, text, now);
            break;
        case 1:
            messages.note(text);
            plain.add(Kind::Note, text, now);
            told.push_back(text);
            break;
        case 2:
            messages.fail(text);
            plain.add(Kind::Failure, text, now);
            if (plain.all.size() > before) told.push_back(text);
            break;
        default:
            ASSERT_EQ(messages.expire(), plain.expire(now)) << step;
        }
        ASSERT_EQ(messages.all().size(), plain.all.size()) << step;
        for (std::size_t i = 0; i < plain.all.size(); ++i) {
            ASSERT_EQ(messages.all()[i].text, plain.all[i].text) << step;
            ASSERT_EQ(messages.all()[i].isError, plain.all[i].kind == Kind::Failure) << step;
            ASSERT_EQ(messages.all()[i].until, plain.all[i].until) << step;
        }
    }
    EXPECT_EQ(heard, told);
}

TEST(RandomHistory, HasTheMediansOfItsLastFramesAlone) {
    Random random(2);
    for (int trial = 0; trial < 100; ++trial) {
        const std::size_t capacity = 1 + random.below(12);
        FrameHistory history(capacity);
        std::vector<StageTimes> all;
        for (std::uint64_t frame = random.below(30); frame > 0; --frame) {
            StageTimes times{};
            for (double& time : times)
                time = static_cast<double>(random.below(8));
            history.add(times);
            all.push_back(times);
            EXPECT_EQ(total(times), std::accumulate(times.begin(), times.end(), 0.0));
        }
        const std::size_t kept = std::min(capacity, all.size());
        ASSERT_EQ(history.frames().size(), kept);
        EXPECT_TRUE(std::equal(
            history.frames().begin(), history.frames().end(), all.end() - static_cast<std::ptrdiff_t>(kept)));
        const std::size_t asked = 1 + random.below(15);
        const std::size_t used = std::min(asked, kept);
        for (std::size_t stage = 0; stage < kStages; ++stage) {
            std::vector<double> values;
            for (std::size_t i = all.size() - used; i < all.size(); ++i)
                values.push_back(all[i][stage]);
            std::sort(values.begin(), values.end());
            const double middle = used == 0 ? 0 : (values[(used - 1) / 2] + values[used / 2]) / 2;
            EXPECT_DOUBLE_EQ(history.medians(asked)[stage], middle);
        }
    }
}

TEST(RandomHistory, TakesEachStageOfARowWhereTheGraphHasIt) {
    telemetry::FrameRow row;
    EXPECT_EQ(stageTimes(row, 7), (StageTimes{0, 0, 0, 0, 0, 0, 7})) << "what was not measured takes no time";
    row.planMs = 1;
    row.selectMs = 2;
    row.cullMs = 3;
    row.streamMs = 4;
    row.shadowMs = 5;
    row.imageMs = 6;
    EXPECT_EQ(stageTimes(row, 7), (StageTimes{1, 2, 3, 4, 5, 6, 7}));
}

TEST(LoadWords, SayWhatIsDrawnAgainstItsCapsAndWarnOnlyOfWhatIs) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        telemetry::FrameRow row;
        plan::Quality quality;
        const Caps caps{random.below(1000), random.bits() >> 30U, random.bits() >> 30U};
        row.imageTriangles = static_cast<std::int64_t>(random.below(1'000'000'000));
        row.pagesMissing = static_cast<std::int64_t>(random.below(3));
        row.pagesDamaged = static_cast<std::int64_t>(random.below(3));
        row.residentBytes = static_cast<std::int64_t>(random.bits() >> 30U);
        if (random.below(2) == 0) row.gpuBytes = static_cast<std::int64_t>(random.bits() >> 30U);
        if (random.below(2) == 0) quality.maxTriangles = 1 + random.below(1'000'000);
        row.backend = "software";
        std::string all;
        for (const std::string& line : loadInWords(row, quality, caps, 17))
            all += line + "\n";
        const auto says = [&](const std::string& words) { return all.find(words) != std::string::npos; };
        const auto count = [](auto value) { return readableCount(static_cast<std::uint64_t>(value)); };
        EXPECT_TRUE(says("triangles " + count(*row.imageTriangles) + " in view, " + count(0) + " into maps")) << all;
        EXPECT_TRUE(says("pages 17 of " + std::to_string(caps.pages) + " in the cut")) << all;
        EXPECT_EQ(says("on their way"), *row.pagesMissing > 0) << all;
        EXPECT_EQ(says(std::to_string(*row.pagesDamaged) + " DAMAGED"), *row.pagesDamaged > 0) << all;
        EXPECT_EQ(says("(cap "), quality.maxTriangles.has_value()) << all;
        EXPECT_EQ(says("drawing "), row.gpuBytes.has_value()) << all;
        EXPECT_TRUE(says(
            "memory " + readableBytes({static_cast<std::uint64_t>(*row.residentBytes)}) + " of " +
            readableBytes({caps.memoryBytes})))
            << all;
    }
}

/// A plan over a ground, seen from anywhere around it.
plan::FramePlan anyPlan(Random& random, const Box& bounds) {
    plan::View view;
    const double angle = random.uniform(0, 6.28);
    view.camera.eye = bounds.center() + glm::dvec3(30 * std::cos(angle), random.uniform(2, 20), 30 * std::sin(angle));
    view.camera.target = bounds.center();
    view.camera.fovYRadians = random.uniform(0.5, 1.4);
    plan::Quality quality;
    quality.zPartitions = 1 + static_cast<int>(random.below(4));
    plan::SceneFacts facts;
    facts.bounds = bounds;
    facts.visible = plan::SceneFacts::Visible{random.uniform(10, 20), random.uniform(40, 50), true};
    return plan::planFrame(view, quality, facts).plan;
}

TEST(RandomPlanVolumes, AreTheViewAndTwoForEachPass) {
    Random random(4);
    const Box bounds{{-10, -2, -10}, {10, 2, 10}};
    for (int trial = 0; trial < 40; ++trial) {
        const plan::FramePlan plan = anyPlan(random, bounds);
        const std::vector<PlanVolume> volumes = planVolumes(plan, bounds);
        ASSERT_EQ(volumes.size(), 1 + 2 * plan.passes.size());
        EXPECT_EQ(volumes[0].kind, PlanVolume::Kind::View);
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            EXPECT_EQ(volumes[1 + 2 * i].kind, PlanVolume::Kind::Partition);
            EXPECT_EQ(volumes[2 + 2 * i].kind, PlanVolume::Kind::Casters);
            EXPECT_EQ(volumes[1 + 2 * i].index, i);
            EXPECT_EQ(volumes[2 + 2 * i].index, i);
        }
    }
}

// Ends of edges lie in what was asked for: within the view's four sides and depths, and about the model and the eye.
TEST(RandomPlanVolumes, LieWithinTheViewAndAboutTheModel) {
    Random random(5);
    const Box bounds{{-10, -2, -10}, {10, 2, 10}};
    std::size_t ends = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const plan::FramePlan plan = anyPlan(random, bounds);
        Box limit = bounds;
        limit.add(plan.view.camera.eye);
        const glm::dvec3 margin = limit.extent() * 0.021;
        const auto volumes = planVolumes(plan, bounds);
        for (const PlanVolume& volume : volumes)
            for (const Segment& segment : volume.edges)
                for (const glm::dvec3& end : segment) {
                    for (int axis = 0; axis < 3; ++axis) {
                        EXPECT_GE(end[axis], limit.min[axis] - margin[axis]);
                        EXPECT_LE(end[axis], limit.max[axis] + margin[axis]);
                    }
                    ++ends;
                    if (volume.kind != PlanVolume::Kind::View) continue;
                    const glm::dvec3 seen = toCamera(plan.basis, end - plan.view.camera.eye);
                    EXPECT_LE(std::abs(seen.x), seen.z * plan.view.tanHalfX() + 1e-6);
                    EXPECT_LE(std::abs(seen.y), seen.z * plan.view.tanHalfY() + 1e-6);
                    EXPECT_GE(seen.z, plan.near - 1e-6);
                    EXPECT_LE(seen.z, plan.far + 1e-6);
                }
    }
    EXPECT_GT(ends, 1000U);
}

TEST(RandomWireFrames, AreTheSameVolumeInTheWorld) {
    Random random(6);
    for (int trial = 0; trial < 300; ++trial) {
        glm::dvec3 eye;
        glm::dvec3 normal;
        glm::dvec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            eye[axis] = random.uniform(-100, 100);
            normal[axis] = random.uniform(-1, 1);
            point[axis] = random.uniform(-100, 100);
        }
        if (glm::length(normal) < 0.1) continue;
        const Camera camera{eye, eye + normal, {0, 1, 0}, 1};
        ConvexVolume volume;
        volume.planes = {{glm::normalize(normal), random.uniform(-9, 9)}, {{0, 0, 1}, random.uniform(-9, 9)}};
        const ConvexVolume world = inWorld(volume, camera);
        ASSERT_EQ(world.planes.size(), 2U);
        const glm::dvec3 inCamera = toCamera(cameraBasis(camera), point - eye);
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_NEAR(world.planes[i].signedDistance(point), volume.planes[i].signedDistance(inCamera), 1e-9);
    }
}

/// What is known of a pad, cell by cell.
struct PadCells {
    std::size_t inDisc = 0;
    std::vector<double> found;
};

PadCells cellsOf(const TexelPlot& plot, int side) {
    PadCells cells;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            cells.inDisc += glm::length(plot.middle(column, row)) <= 1 ? 1 : 0;
            if (const auto value = plot.at(column, row)) cells.found.push_back(*value);
        }
    return cells;
}

TEST(RandomTexelPlot, FindsEachCellOnceAndAsManyAsItIsAskedFor) {
    Random random(7);
    for (const int side : {1, 2, 5, 8, 16}) {
        TexelPlot plot(side);
        EXPECT_TRUE(plot.isComplete()) << "nobody has asked";
        EXPECT_FALSE(plot.range());
        TexelPlotInput input;
        input.frustum = {1, 50, 0.5, 1};
        input.scheme.slices = 1;
        plot.ask(input);
        const std::size_t inDisc = cellsOf(plot, side).inDisc;
        std::size_t asked = 0;
        while (!plot.isComplete()) {
            const std::size_t count = 1 + random.below(4);
            plot.improve(static_cast<int>(count));
            asked += count;
            ASSERT_EQ(cellsOf(plot, side).found.size(), std::min(asked, inDisc)) << side;
            plot.ask(input); // again, which changes nothing
            ASSERT_LE(asked, inDisc + 8) << "it never ends";
        }
        ASSERT_TRUE(plot.range());
        const std::vector<double> found = cellsOf(plot, side).found;
        EXPECT_EQ(plot.range()->min, *std::min_element(found.begin(), found.end()));
        EXPECT_EQ(plot.range()->max, *std::max_element(found.begin(), found.end()));
    }
}

TEST(KeyHelp, NamesShiftExactlyWhereTheKeyNeedsIt) {
    for (const Binding& binding : bindings()) {
        EXPECT_EQ(binding.keyName.starts_with("Shift+"), binding.withShift) << binding.keyName;
        EXPECT_EQ(bindingOf(binding.key, binding.withShift), &binding) << binding.keyName;
        EXPECT_EQ(binding.setting.empty(), binding.action != Action::StepSetting) << binding.keyName;
    }
    std::set<std::string> gestures;
    for (const MouseUse& use : mouseUses())
        EXPECT_TRUE(gestures.insert(use.gesture).second && !std::string(use.help).empty()) << use.gesture;
}

TEST(KeyHelp, EveryKeyChangesWhatIsShownOrTheQualityOrNeither) {
    for (const Binding& binding : bindings()) {
        ViewSettings view;
        settings::Settings settings;
        const bool isShown = changeShown(binding, view);
        const bool isQuality = changeQuality(binding, settings).has_value();
        EXPECT_FALSE(isShown && isQuality) << binding.keyName;
        EXPECT_EQ(isQuality, binding.action == Action::StepScheme || binding.action == Action::StepSetting);
        if (!isQuality) {
            EXPECT_TRUE(settings::areAlike(settings, settings::Settings())) << binding.keyName;
        }
        if (!isShown || binding.action == Action::SetOverlay) continue;
        EXPECT_TRUE(changeShown(binding, view)); // once more takes it back
        const ViewSettings untouched;
        EXPECT_EQ(view.showsFacts, untouched.showsFacts);
        EXPECT_EQ(view.showsHelp, untouched.showsHelp);
        EXPECT_EQ(view.showsPanel, untouched.showsPanel);
    }
}

} // namespace
} // namespace gnomon::viewer
