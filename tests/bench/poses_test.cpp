// Frames from anywhere: inside the model, outside, far away, far from the world's origin, of one pixel, of nothing.
#include "core/error.h"
#include "core/random.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "task/session.h"
#include "tests/support/temporary_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gnomon::bench {
namespace {

/// Draws seeded poses of one model and looks at all that comes out.
class Poser {
public:
    Poser(const glm::dvec3& origin, settings::Backend backend)
        : file_(options(origin), "poses"), settings_(drawnBy(backend)) {
        session_ = std::make_unique<task::Session>(
            file_.path(), settings_, [](const std::string& warning) { ADD_FAILURE() << warning; });
    }

    /// False if the frame was refused, with a reason.
    bool draw(Random& random) {
        plan::View view = pose(random);
        const plan::Quality quality = anyQuality(random);
        if (random.below(4) != 0) history_ = {};
        frame::FrameOptions options;
        options.waiting = random.below(2) == 0 ? frame::Waiting::Never : frame::Waiting::UntilComplete;
        options.wantsSurfaces = random.below(8) == 0;
        try {
            const frame::Frame frame = session_->renderer().render(view, quality, options, history_);
            history_ = frame.history;
            expectSound(frame, view);
            return true;
        } catch (const Error& error) {
            EXPECT_GT(std::string(error.what()).size(), 10U);
            return false;
        }
    }

private:
    static tests::TinyModelOptions options(const glm::dvec3& origin) {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 10;
        options.origin = origin;
        return options;
    }

    static settings::Settings drawnBy(settings::Backend backend) {
        settings::Settings settings;
        settings.backend = backend;
        return settings;
    }

    glm::dvec3 direction(Random& random) const {
        constexpr std::array<glm::dvec3, 6> kAxes = {
            glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        if (random.below(3) == 0) return kAxes[random.below(kAxes.size())];
        const double x = random.uniform(-1, 1);
        const double y = random.uniform(-1, 1);
        const double z = random.uniform(-1, 1);
        return glm::dvec3(x, y, z) + glm::dvec3(1e-3);
    }

    glm::dvec3 inside(Random& random) const {
        const Box& bounds = session_->model().summary().bounds;
        const double x = random.uniform(0, 1);
        const double y = random.uniform(0, 1);
        const double z = random.uniform(0, 1);
        return bounds.min + bounds.extent() * glm::dvec3(x, y, z);
    }

    plan::View pose(Random& random) const {
        plan::View view;
        const double size = glm::length(session_->model().summary().bounds.extent());
        const double farAway = std::pow(10, random.uniform(-4, 6)) * size;
        const glm::dvec3 from = inside(random);
        view.camera.eye = random.below(2) == 0 ? from : from + direction(random) * farAway;
        view.camera.target = random.below(2) == 0 ? inside(random) : view.camera.eye + direction(random) * size;
        view.camera.up = random.below(3) == 0 ? direction(random) : glm::dvec3(0, 1, 0);
        view.camera.fovYRadians = random.below(3) == 0 ? random.uniform(1e-3, 3.1) : 1;
        view.towardsLight = direction(random);
        if (random.below(8) == 0) view.towardsLight = view.camera.target - view.camera.eye;
        if (random.below(8) == 0) view.towardsLight = view.camera.eye - view.camera.target;
        constexpr std::array kSides = {1, 2, 7, 32, 48};
        view.width = kSides[random.below(kSides.size())];
        view.height = kSides[random.below(kSides.size())];
        return view;
    }

    plan::Quality anyQuality(Random& random) const {
        settings::Settings settings = settings_;
        const auto any = [&](const char* name, std::initializer_list<const char*> texts) {
            const settings::Setting& setting = settings::named(name);
            setting.set(settings, setting.parse(texts.begin()[random.below(texts.size())]));
        };
        any("warp", {"auto", "none", "lspsm", "psm", "tsm", "minimax"});
        any("z-partitions", {"1", "2", "4", "8"});
        any("face-partitions", {"off", "off", "on"});
        any("filter", {"0", "0", "2", "3"});
        any("cull-casters", {"auto", "on", "off"});
        any("shadow-texels", {"64x64", "256x256", "300x40"});
        any("error-pixels", {"0.5", "1", "20"});
        if (settings.quality.warp.rule == shadow::WarpRule::None) any("stabilize", {"off", "on"});
        if (random.below(6) == 0) any("max-triangles", {"1", "100", "3k"});
        return settings::qualityOf(settings);
    }

    void expectSound(const frame::Frame& frame, const plan::View& view) const {
        for (const telemetry::Column& column : telemetry::columns()) {
            const telemetry::Value value = column.value(frame.row);
            const double* number = std::get_if<double>(&value);
            EXPECT_FALSE(number != nullptr && std::isnan(*number)) << column.name;
        }
        EXPECT_LT(frame.row.near, frame.row.far);
        const render::Picture picture = session_->backend().picture();
        EXPECT_EQ(picture.width, view.width);
        EXPECT_EQ(picture.height, view.height);
        std::size_t nans = 0;
        for (const float depth : session_->backend().viewDepth().pixels)
            nans += std::isnan(depth) || depth < 0 ? 1 : 0;
        for (const float depth : session_->backend().shadowDepth().pixels)
            nans += std::isnan(depth) || depth < 0 || depth > 1 ? 1 : 0;
        EXPECT_EQ(nans, 0U);
        for (const plan::ShadowPass& pass : frame.plan.passes) {
            EXPECT_TRUE(std::isfinite(pass.map.aliasingBound.x) && std::isfinite(pass.map.aliasingBound.z));
            EXPECT_GT(pass.map.innerRectangle().width, 0);
            EXPECT_GT(pass.map.innerRectangle().height, 0);
        }
    }

    tests::TemporaryModel file_;
    settings::Settings settings_;
    std::unique_ptr<task::Session> session_;
    frame::History history_;
};

void drawPoses(int count, settings::Backend backend) {
    int drawn = 0;
    for (const glm::dvec3& origin : {glm::dvec3(0), glm::dvec3(1e7, -3e5, 1e7)}) {
        Poser poser(origin, backend);
        for (int i = 0; i < count / 2; ++i) {
            Random random(static_cast<std::uint64_t>(i) + 1);
            SCOPED_TRACE("pose " + std::to_string(i) + " at origin " + std::to_string(origin.x));
            drawn += poser.draw(random) ? 1 : 0;
            if (testing::Test::HasFailure()) return;
        }
    }
    EXPECT_GT(drawn, count * 9 / 10) << "most poses are possible";
}

TEST(Poses, AnyPoseDrawsOrSaysWhyNot) {
    drawPoses(300, settings::Backend::Software);
}

TEST(SlowPoses, TenThousandPosesDrawOrSayWhyNot) {
    drawPoses(10000, settings::Backend::Software);
}

TEST(SlowPoses, OpenGlDrawsAnyPose) {
    drawPoses(600, settings::Backend::Osmesa);
}

} // namespace
} // namespace gnomon::bench
