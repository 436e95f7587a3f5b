#include "frame/renderer.h"

#include "executor/lod_substitutes.h"
#include "executor/view/section_memory.h"
#include "frame/frame_cuts.h"
#include "plan/map_reuse.h"
#include "plan/view_jump.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

bool cullsByReceivers(const PreparedFrame& frame, const FrameOptions& options) {
    const bool wantsWhole = options.wantsWholeMaps || options.isAccumulated;
    return frame.plan.casterCulling == plan::CasterCulling::Receivers && !wantsWhole;
}

/// Clips nothing within `bounds` that the parallel lines of sight of `camera` meet.
void clipAround(const Camera& camera, const Box& bounds, executor::FrameDrawing& drawing) {
    constexpr double kBeyond = 1.01;
    const glm::dvec3 view = cameraBasis(camera).view;
    const double middle = glm::dot(view, bounds.center() - camera.eye);
    const double reach = std::max(
        kBeyond * 0.5 * glm::dot(glm::abs(view), bounds.extent()), drawing.grid.step() + 1e-9 * std::abs(middle));
    drawing.clipNear = middle - reach;
    drawing.clipFar = middle + reach;
}

} // namespace

Renderer::Renderer(const hierarchy::ModelFile& model, executor::Executor& executor, ResidencyOptions options)
    : model_(&model),
      executor_(&executor),
      residency_(model, std::move(options)),
      sections_(std::make_shared<executor::SectionMemory>()) {}

plan::FramePlan Renderer::plan(const plan::View& view, const plan::Quality& quality) {
    return prepare(view, quality, Waiting::UntilComplete, previous_).plan;
}

/// What the frames before drew is still there to be told of.
void Renderer::forgetIfJumped(const plan::View& view) {
    if (!previous_ || !plan::hasJumped(*viewBefore_, farthestBefore_, view)) return;
    previous_ = std::make_shared<const plan::PlannedFrame>(plan::PlannedFrame{previous_->plan, {}});
    wasSunless_ = false;
}

/// Whether so much of the frame that was just drawn is lit, or so little, that it has to be drawn the other way. Where
/// the frame before was drawn without sun it takes more light to bring it back, so that nothing flickers.
bool Renderer::hasSunWrong(const Frame& frame) const {
    constexpr double kNextToNothing = 0.005; // of the pixels
    constexpr double kEnough = 0.02;
    const plan::FramePlan& plan = frame.plan;
    const bool isLeftOpen = plan.quality.look.shading == plan::Shading::Auto && !frame.options.observerCamera;
    if (!isLeftOpen || !frame.facts.visible || !frame.facts.visible->anything) return false;
    const double pixels = static_cast<double>(plan.view.width) * plan.view.height;
    const std::optional<std::uint64_t> litPixels = executor_->litPixels();
    if (!litPixels) return false;
    const double lit = static_cast<double>(*litPixels) / pixels;
    return frame.isSunless ? lit >= kEnough : lit < kNextToNothing;
}

void Renderer::markReusedMaps(PreparedFrame& frame, const FrameOptions& options) const {
    if (!heldMaps_) return;
    const HeldMaps& held = *heldMaps_;
    if (held.isCulled) {
        // What is missing from them was missed by nobody, as long as the very same is asked.
        const bool isAskedTheSame =
            cullsByReceivers(frame, options) && !options.observerCamera && !held.options.observerCamera &&
            options.overlay == held.options.overlay && options.subpixel == held.options.subpixel &&
            options.wantsSurfaces == held.options.wantsSurfaces && frame.cut.lists[0].ranges == held.image &&
            plan::isSameQuestion(frame.plan, held.plan);
        if (!isAskedTheSame) return;
    }
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        frame.plan.passes[p].isReused =
            plan::isSameMap(frame.plan, held.plan, p) && frame.cut.lists[p + 1].ranges == held.casters[p];
}

void Renderer::rememberMaps(const PreparedFrame& frame, const FrameOptions& options, bool isCulled) {
    HeldMaps& held = heldMaps_.emplace();
    held.plan = frame.plan;
    held.isCulled = isCulled;
    held.image = frame.cut.lists[0].ranges;
    held.options = options;
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        held.casters.push_back(frame.cut.lists[p + 1].ranges);
}

executor::FrameDrawing Renderer::drawing(const PreparedFrame& frame, const FrameOptions& options) const {
    const hierarchy::ModelSummary& summary = model_->summary();
    executor::FrameDrawing drawing;
    drawing.plan = &frame.plan;
    drawing.space = frame.space;
    drawing.grid = summary.grid;
    drawing.image = &frame.cut.lists[0];
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        drawing.casters.push_back(&frame.cut.lists[p + 1]);
    const std::size_t planes = frame.plan.view.sections.size();
    for (std::size_t i = frame.cut.lists.size() - planes; i < frame.cut.lists.size(); ++i)
        drawing.sections.push_back(&frame.cut.lists[i]);
    drawing.sectionMemory = sections_.get();
    sections_->cut.begin(drawing);
    drawing.pages = [resident = residency_.resident()](std::uint32_t page) -> const hierarchy::Page& {
        return *resident[page];
    };
    // Reversed float depth is as precise anywhere; only triangles that cross the near plane want it not too near.
    const plan::SceneFacts::Visible visible = frame.facts.visible.value_or(plan::SceneFacts::Visible{});
    const double least = std::max(1e-7 * visible.farthest, 1e-3 * summary.grid.step());
    drawing.clipNear = std::max(visible.anything ? visible.nearest * 0.99 : 0.0, least);
    if (options.observerCamera) {
        drawing.observerCamera = options.observerCamera;
        drawing.clipNear = std::max(distance(summary.bounds, options.observerCamera->eye) * 0.99, least);
    }
    const Camera camera = options.observerCamera.value_or(frame.plan.view.camera);
    if (camera.isParallel()) clipAround(camera, frame.facts.bounds, drawing);
    drawing.subpixel = options.subpixel;
    drawing.overlay = options.overlay;
    if (frame.ground && !options.observerCamera && !frame.isSunless) drawing.ground = &frame.ground->page;
    const plan::Shading shading = frame.plan.quality.look.shading;
    const plan::Shading automatic = frame.isSunless ? plan::Shading::Headlight : plan::Shading::Lit;
    drawing.shading = shading == plan::Shading::Auto ? automatic : shading;
    if (options.overlay == executor::Overlay::Residency)
        drawing.substitutes =
            executor::lodSubstitutes(cutQuery(residency_, frame), *drawing.image, [this](std::uint32_t page) {
                return residency_.isDamaged(page);
            });
    drawing.wantsSurfaces = options.wantsSurfaces;
    drawing.lightPart = options.lightPart;
    drawing.skyWeight = options.skyWeight;
    drawing.groundShade = options.groundShade;
    drawing.tiles = options.tiles.get();
    drawing.wantsLight = options.isAccumulated && !options.wantsSurfaces;
    drawing.cullsByReceivers = cullsByReceivers(frame, options);
    return drawing;
}

} // namespace gnomon::frame
