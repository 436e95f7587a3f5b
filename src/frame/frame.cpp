#include "culling/caster_detail.h"
#include "culling/frame_cut.h"
#include "executor/stand_ins.h"
#include "frame/prepared_frame.h"
#include "frame/scene_facts.h"
#include "plan/map_reuse.h"
#include "selection/nearest_depth.h"

#include <algorithm>
#include <chrono>
#include <cmath>

// The frame, told in the words of the README: plan -> cut -> cull per partition -> shadow passes -> image pass -> log.

namespace gnomon::frame {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsBetween(Clock::time_point start, Clock::time_point end) {
    return std::chrono::duration<double, std::milli>(end - start).count();
}

/// Adds the time of its life to a sum.
class Stopwatch {
public:
    explicit Stopwatch(double& sum) : sum_(sum), start_(Clock::now()) {}

    ~Stopwatch() { sum_ += millisecondsBetween(start_, Clock::now()); }

    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    Stopwatch(Stopwatch&&) = delete;
    Stopwatch& operator=(Stopwatch&&) = delete;

private:
    double& sum_;
    Clock::time_point start_;
};

std::int64_t toCount(std::uint64_t value) {
    return static_cast<std::int64_t>(value);
}

} // namespace

Renderer::Renderer(const hierarchy::ModelFile& model, executor::Executor& executor, ResidencyOptions options)
    : model_(&model), executor_(&executor), residency_(model, std::move(options)) {}

Frame Renderer::render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    const auto start = Clock::now();
    Prepared prepared = prepare(view, quality, options.waiting);
    if (options.reusesMaps) reuseMaps(prepared);
    const executor::DrawStatistics drawn = draw(prepared, drawing(prepared, options));
    Frame frame;
    frame.space = executor::drawSpace(view, model_->summary().grid, model_->summary().bounds);
    frame.row = logged(prepared, drawn);
    frame.row.totalMs = millisecondsBetween(start, Clock::now());
    prove(prepared, options, frame);
    frame.plan = prepared.plan;
    frame.cut = std::move(prepared.cut);
    previous_ = std::move(prepared.plan);
    return frame;
}

void Renderer::reuseMaps(Prepared& prepared) const {
    if (!heldMaps_) return;
    for (std::size_t p = 0; p < prepared.plan.passes.size(); ++p)
        prepared.plan.passes[p].isReused = plan::isSameMap(prepared.plan, heldMaps_->plan, p) &&
                                           prepared.cut.lists[p + 1].ranges == heldMaps_->casters[p];
}

plan::FramePlan Renderer::plan(const plan::View& view, const plan::Quality& quality) {
    return prepare(view, quality, Waiting::UntilComplete).plan;
}

Renderer::Prepared Renderer::prepare(const plan::View& view, const plan::Quality& quality, Waiting waiting) {
    double streamMs = 0; // all that waiting costs: the rounds but the last are made for it
    {
        const Stopwatch watch(streamMs);
        residency_.begin(waiting);
    }
    for (;;) {
        const auto start = Clock::now();
        Prepared prepared = planAndCut(view, quality);
        const auto cut = Clock::now();
        prepared.residency = residency_.meet(query(prepared), prepared.cut, waiting);
        const bool isLast = waiting == Waiting::Never || !prepared.residency.hasChanged;
        streamMs += millisecondsBetween(isLast ? cut : start, Clock::now());
        prepared.streamMs = streamMs;
        if (isLast) return prepared;
    }
}

Renderer::Prepared Renderer::planAndCut(const plan::View& view, const plan::Quality& quality) {
    Prepared prepared;
    const Box& bounds = model_->summary().bounds;
    const std::optional<DepthSpan> range = plan::widestRange(view, quality, bounds);
    {
        const Stopwatch watch(prepared.selectMs);
        cutView(prepared, view, quality, range);
    }
    {
        const Stopwatch watch(prepared.cullMs);
        prepared.facts = sceneFacts(view, bounds, query(prepared), prepared.cut, range);
    }
    {
        const Stopwatch watch(prepared.planMs);
        prepared.plan = plan::planFrame(view, quality, prepared.facts, previous_ ? &*previous_ : nullptr);
    }
    if (prepared.plan.passes.empty() && !prepared.isRayTraced()) {
        prepared.volumes.resize(1);
        prepared.cut.lists.resize(1);
        return prepared;
    }
    const Stopwatch watch(prepared.cullMs);
    cutAll(prepared);
    return prepared;
}

selection::CutQuery Renderer::query(const Prepared& prepared) const {
    selection::CutQuery query = residency_.query();
    query.rule = prepared.rule.get();
    query.errorPixels = prepared.errorPixels;
    query.volumes = prepared.volumes;
    return query;
}

void Renderer::cut(Prepared& prepared, const plan::Quality& quality) const {
    prepared.errorPixels = quality.errorPixels;
    if (quality.maxTriangles)
        prepared.errorPixels = selection::cappedErrorPixels(query(prepared), *quality.maxTriangles);
    prepared.cut = culling::cutFrame(query(prepared));
}

void Renderer::cutView(
    Prepared& prepared,
    const plan::View& view,
    const plan::Quality& quality,
    const std::optional<DepthSpan>& range) const {
    selection::DetailView detail = detailView(view, view.camera.eye - model_->summary().grid.origin);
    const double nearest = selection::nearestDepth(*residency_.query().trees, detail);
    if (std::isfinite(nearest)) detail.nearestDepth = std::max(detail.nearestDepth, nearest);
    prepared.rule = std::make_unique<selection::ErrorRule>(detail);
    prepared.volumes = {selection::viewPyramid(detail)};
    if (range) prepared.volumes.push_back(culling::localVolume(plan::sweptView(view, *range), detail));
    cut(prepared, quality);
}

void Renderer::cutAll(Prepared& prepared) const {
    const selection::DetailView view = prepared.rule->view();
    prepared.volumes.resize(1);
    std::vector<selection::CasterDetail> casters;
    for (const plan::ShadowPass& pass : prepared.plan.passes) {
        casters.push_back(culling::casterDetail(view, pass.map));
        // Without culling every map draws all there is, at the detail that the maps call for.
        prepared.volumes.push_back(prepared.plan.quality.cullCasters ? casters.back().casters : ConvexVolume{});
    }
    if (prepared.isRayTraced()) {
        casters.push_back(rayCasterDetail(prepared));
        prepared.volumes.push_back(casters.back().casters);
    }
    prepared.rule = std::make_unique<selection::ErrorRule>(view, std::move(casters));
    cut(prepared, prepared.plan.quality);
}

executor::FrameDrawing Renderer::drawing(const Prepared& prepared, const FrameOptions& options) const {
    const hierarchy::ModelSummary& summary = model_->summary();
    executor::FrameDrawing drawing;
    drawing.plan = &prepared.plan;
    drawing.space = executor::drawSpace(prepared.plan.view, summary.grid, summary.bounds);
    drawing.grid = summary.grid;
    drawing.image = &prepared.cut.lists[0];
    for (std::size_t p = 0; p < prepared.plan.passes.size(); ++p)
        drawing.casters.push_back(&prepared.cut.lists[p + 1]);
    drawing.pages = [resident = residency_.resident()](std::uint32_t page) -> const hierarchy::Page& {
        return *resident[page];
    };
    // Reversed float depth is as precise anywhere; only triangles that cross the near plane want it not too near.
    const plan::SceneFacts::Visible visible = prepared.facts.visible.value_or(plan::SceneFacts::Visible{});
    const double least = std::max(1e-7 * visible.farthest, 1e-3 * summary.grid.step());
    drawing.clipNear = std::max(visible.anything ? visible.nearest * 0.99 : 0.0, least);
    if (options.onlooker) {
        drawing.onlooker = options.onlooker;
        drawing.clipNear = std::max(distance(summary.bounds, options.onlooker->eye) * 0.99, least);
    }
    drawing.overlay = options.overlay;
    if (options.overlay == executor::Overlay::Residency)
        drawing.standIns = executor::standIns(
            query(prepared), *drawing.image, [this](std::uint32_t page) { return residency_.isDamaged(page); });
    drawing.wantsSurfaces = options.wantsSurfaces;
    return drawing;
}

telemetry::FrameRow Renderer::logged(const Prepared& prepared, const executor::DrawStatistics& drawn) const {
    const plan::FramePlan& plan = prepared.plan;
    const plan::Quality& quality = plan.quality;
    telemetry::FrameRow row;
    row.model = model_->path();
    row.scheme = plan::schemeName(plan);
    row.warp = shadow::name(quality.warp.rule);
    row.zPartitions = plan.splits.empty() ? 0 : toCount(plan.splits.size() - 1);
    row.facePartitions = plan.hasFaces ? "on" : "off";
    row.stabilize = quality.stabilize;
    row.filter = quality.filter;
    row.shadowMaps = toCount(plan.passes.size());
    row.shadowMapsDrawn = 0;
    row.cullCasters = quality.cullCasters;
    row.shadowTexels = std::to_string(quality.shadowTexelsWidth) + "x" + std::to_string(quality.shadowTexelsHeight);
    row.errorPixels = quality.errorPixels;
    row.width = plan.view.width;
    row.height = plan.view.height;
    row.backend = executor_->name();
    row.planMs = prepared.planMs;
    row.selectMs = prepared.selectMs;
    row.cullMs = prepared.cullMs;
    row.streamMs = prepared.streamMs;
    row.shadowMs = drawn.shadowMs;
    row.imageMs = drawn.imageMs;
    row.imageTriangles = toCount(prepared.cut.lists[0].triangles);
    std::uint64_t shadowTriangles = 0;
    std::uint64_t castersKept = 0;
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        if (!plan.passes[p].isReused) {
            ++row.shadowMapsDrawn;
            shadowTriangles += prepared.cut.lists[p + 1].triangles;
        }
        castersKept += prepared.cut.lists[p + 1].clusters;
    }
    row.shadowTriangles = toCount(shadowTriangles);
    if (drawn.shadowFragments) row.shadowFragments = toCount(*drawn.shadowFragments);
    row.castersKept = toCount(castersKept);
    row.castersTested = toCount(plan.passes.empty() ? 0 : prepared.cut.clustersTested);
    row.drawCalls = toCount(drawn.drawCalls);
    row.residentBytes = toCount(residency_.statistics().resident.count);
    row.gpuBytes = toCount(drawn.deviceBytes);
    row.bytesRead = toCount(residency_.statistics().read.count);
    row.pagesMissing = toCount(prepared.residency.pagesMissing);
    row.pagesDamaged = toCount(residency_.statistics().pagesDamaged);
    row.achievedErrorPixels = prepared.cut.achievedErrorPixels;
    row.near = plan.near;
    row.far = plan.far;
    row.depthRatio = plan.far / plan.near;
    row.lightAngle = plan.lightAngleRadians * 180 / 3.14159265358979323846;
    if (plan.passes.empty()) return row;
    row.storageFactor = plan.storageFactor;
    row.promisedAliasingX = plan.promised.x;
    row.promisedAliasingZ = plan.promised.z;
    row.promiseKept = plan.promiseKept;
    return row;
}

} // namespace gnomon::frame
