#include "tests/support/field.h"

#include "core/random.h"
#include "plan/distant_view.h"
#include "plan/plan_frame.h"

#include <algorithm>
#include <array>

namespace gnomon::render {

namespace {

struct Depths {
    double nearest = 1;
    double farthest = 120;
};

/// Of all of the field that a view can show.
Depths depthsOf(const plan::View& view) {
    if (!view.camera.isParallel()) return {};
    const double nearest = glm::length(view.camera.target - view.camera.eye);
    return {nearest, nearest * plan::kDistantGrowth};
}

} // namespace

Field::Field() {
    tests::TinyModelOptions options;
    options.gridExponent = 6;
    options.height = 12;
    options.normals = true;
    options.colors = true;
    options.origin = {1e6, -300, 2e5};
    model_ = tests::makeTinyModel(options);
    for (std::uint32_t p = 0; p < model_.pages.size(); ++p)
        if (model_.pages[p].level == 0)
            all_.ranges.push_back({p, 0, static_cast<std::uint32_t>(model_.pages[p].clusters.size())});
}

plan::View Field::view(std::uint64_t seed) const {
    Random random(seed);
    const Box& bounds = model_.summary.bounds;
    const auto inside = [&](double lift) {
        glm::dvec3 point(0);
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = bounds.min[axis] + random.uniform(0.1, 0.9) * (bounds.max[axis] - bounds.min[axis]);
        point.y = bounds.max.y + lift;
        return point;
    };
    plan::View view;
    view.width = view.height = kFieldSide;
    const double above = random.uniform(0.5, 30);
    view.camera.eye = inside(above);
    const double below = random.uniform(-20, -5);
    view.camera.target = inside(below);
    for (int axis = 0; axis < 3; ++axis)
        view.towardsLight[axis] = axis == 1 ? random.uniform(0.15, 1) : random.uniform(-1, 1);
    if (seed % 6 == 5) view.camera.projection = Projection::Orthographic;
    return plan::distantView(view, bounds);
}

DrawInputs Field::drawing(const plan::FramePlan& plan) const {
    DrawInputs frame;
    frame.plan = &plan;
    frame.grid = model_.summary.grid;
    frame.space = cameraRelativeSpace(plan.view, frame.grid, model_.summary.bounds);
    frame.image = &all_;
    frame.casters.assign(plan.passes.size(), &all_);
    frame.pages = [this](std::uint32_t page) -> const hierarchy::Page& { return model_.pages[page]; };
    const Depths depths = depthsOf(plan.view);
    frame.clipNear = plan.view.camera.isParallel() ? depths.nearest : 0.05;
    frame.clipFar = depths.farthest;
    frame.shading = plan.quality.look.shading;
    return frame;
}

std::vector<LodSubstitute> Field::someSubstitutes() const {
    std::vector<LodSubstitute> result;
    for (const lod::ClusterRange& range : all_.ranges)
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; c += 3)
            result.push_back({range.page, c, result.size() % 2 == 0 ? Residence::Pending : Residence::Damaged});
    std::sort(result.begin(), result.end(), [](const LodSubstitute& a, const LodSubstitute& b) {
        return std::pair(a.page, a.cluster) < std::pair(b.page, b.cluster);
    });
    return result;
}

plan::FramePlan Field::plan(const plan::View& view, const plan::Quality& quality) const {
    plan::SceneFacts facts;
    facts.bounds = model_.summary.bounds;
    const Depths depths = depthsOf(view);
    facts.visible = {depths.nearest, depths.farthest, true};
    return plan::planFrame(view, quality, facts).plan;
}

plan::Quality fieldQuality(std::uint64_t seed) {
    plan::Quality quality;
    constexpr std::array kRules = {
        shadow::WarpRule::Auto,
        shadow::WarpRule::None,
        shadow::WarpRule::Lspsm,
        shadow::WarpRule::Psm,
        shadow::WarpRule::Tsm,
        shadow::WarpRule::Minimax};
    quality.warp.rule = kRules[seed % kRules.size()];
    quality.zPartitions = static_cast<int>(1 + seed % 5);
    quality.facePartitions = seed % 3 == 0 ? plan::Choice::On : plan::Choice::Off;
    quality.filter = static_cast<int>(seed % 4);
    if (seed % 7 == 0) {
        quality.warp.rule = shadow::WarpRule::None;
        quality.facePartitions = plan::Choice::Off;
        quality.stabilize = true;
    }
    if (seed % 11 == 0) quality.shadows = plan::ShadowMode::Off;
    quality.look.shading = plan::kShadings[seed % 2 == 0 ? 1 : 1 + seed / 2 % 4].value;
    quality.look.ambient = 0.5 * static_cast<double>(1 + seed % 3);
    if (seed % 5 == 0) quality.look.background = {plan::Background::Kind::Color, {20, 90, 160}};
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512;
    return quality;
}

plan::Quality softwareQuality(std::uint64_t seed) {
    plan::Quality quality = fieldQuality(seed);
    if (seed % 3 == 1 && !quality.stabilize) {
        quality.warp.rule = shadow::WarpRule::Log;
        quality.facePartitions = seed % 2 == 0 ? plan::Choice::On : plan::Choice::Off;
    }
    return quality;
}

} // namespace gnomon::render
