#include "frame/renderer.h"

#include "frame/frame_cuts.h"
#include "render/lod_substitutes.h"
#include "render/view/section_memory.h"

#include <algorithm>
#include <cmath>

namespace gnomon::frame {

namespace {

bool cullsByReceivers(const PreparedFrame& frame, const FrameOptions& options) {
    const bool wantsWhole = options.wantsWholeMaps || options.isAccumulated;
    return frame.plan.casterCulling == plan::CasterCulling::Receivers && !wantsWhole;
}

/// Sets the clip planes of `drawing` such that an orthographic image from `camera` shows all geometry within `bounds`.
void clipAround(const Camera& camera, const Box& bounds, render::DrawInputs& drawing) {
    constexpr double kClipMargin = 1.01;
    const glm::dvec3 view = cameraBasis(camera).view;
    const double middle = glm::dot(view, bounds.center() - camera.eye);
    const double reach = std::max(
        kClipMargin * 0.5 * glm::dot(glm::abs(view), bounds.extent()), drawing.grid.step() + 1e-9 * std::abs(middle));
    drawing.clipNear = middle - reach;
    drawing.clipFar = middle + reach;
}

} // namespace

Renderer::Renderer(const hierarchy::ModelFile& model, render::Backend& backend, ResidencyOptions options)
    : model_(&model),
      backend_(&backend),
      residency_(model, std::move(options)),
      sections_(std::make_shared<render::SectionMemory>()) {}

plan::FramePlan Renderer::plan(const plan::View& view, const plan::Quality& quality) {
    return prepare(view, quality).plan;
}

bool Renderer::isNegligible(std::uint64_t litPixels, const plan::View& view) {
    return litPixels < minLitPixels(view);
}

std::uint64_t Renderer::minLitPixels(const plan::View& view) {
    constexpr double kNegligible = 0.005; // fraction of the pixels
    return static_cast<std::uint64_t>(std::ceil(kNegligible * view.width * view.height));
}

render::DrawInputs Renderer::drawing(const PreparedFrame& frame, const FrameOptions& options) const {
    const hierarchy::ModelSummary& summary = model_->summary();
    render::DrawInputs drawing;
    drawing.plan = &frame.plan;
    drawing.space = frame.space;
    drawing.grid = summary.grid;
    drawing.image = &frame.cut.lists.image;
    for (std::size_t p = 0; p < frame.plan.passes.size(); ++p)
        drawing.casters.push_back(&frame.cut.lists.casters[p]);
    for (const lod::DrawList& list : frame.cut.lists.sections)
        drawing.sections.push_back(&list);
    if (frame.hasOneCasterList()) drawing.exactCasters = &frame.cut.lists.casters.front();
    drawing.sectionMemory = sections_.get();
    sections_->cut.begin(drawing);
    drawing.pages = [resident = residency_.resident()](std::uint32_t page) -> const hierarchy::Page& {
        return *resident[page];
    };
    // Reversed float depth has the same precision for any near plane. The min near depth is needed only for triangles
    // that cross a near plane close to the eye.
    const plan::SceneFacts::Visible visible = frame.facts.visible.value_or(plan::SceneFacts::Visible{});
    const double minNear = std::max(1e-7 * visible.farthest, 1e-3 * summary.grid.step());
    drawing.clipNear = std::max(visible.anything ? visible.nearest * 0.99 : 0.0, minNear);
    if (options.observerCamera) {
        drawing.observerCamera = options.observerCamera;
        drawing.clipNear = std::max(distance(summary.bounds, options.observerCamera->eye) * 0.99, minNear);
    }
    const Camera camera = options.observerCamera.value_or(frame.plan.view.camera);
    if (camera.isParallel()) clipAround(camera, frame.facts.bounds, drawing);
    drawing.subpixel = options.subpixel;
    drawing.overlay = options.overlay;
    if (frame.ground && !options.observerCamera && !frame.usesHeadlight) drawing.ground = &frame.ground->page;
    const plan::Shading shading = frame.plan.quality.look.shading;
    const plan::Shading automatic = frame.usesHeadlight ? plan::Shading::Headlight : plan::Shading::Lit;
    drawing.shading = shading == plan::Shading::Auto ? automatic : shading;
    if (options.overlay == render::Overlay::Residency)
        drawing.substitutes =
            render::lodSubstitutes(cutQuery(residency_, frame), *drawing.image, [this](std::uint32_t page) {
                return residency_.isDamaged(page);
            });
    drawing.wantsSurfaces = options.wantsSurfaces;
    drawing.lightPart = options.lightPart;
    drawing.skyWeight = options.skyWeight;
    drawing.groundShade = options.groundShade;
    drawing.tiles = options.tiles.get();
    drawing.rows = options.rows;
    drawing.wantsLight = options.isAccumulated && !options.wantsSurfaces;
    drawing.cullsByReceivers = cullsByReceivers(frame, options);
    return drawing;
}

} // namespace gnomon::frame
