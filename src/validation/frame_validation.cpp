#include "validation/frame_validation.h"

#include "frame/frame_cuts.h"
#include "frame/ray_casters.h"
#include "render/exact_pass.h"
#include "render/ray_shadows.h"
#include "validation/ray_memory.h"

#include <algorithm>
#include <array>

namespace gnomon::validation {

namespace {

/// Prepares the view of `frame` at the finest level of detail, with all casters that shadow rays can hit.
frame::PreparedFrame finest(frame::Renderer& renderer, const frame::Frame& frame, plan::ShadowMode shadows) {
    plan::Quality quality = frame.plan.quality;
    quality.shadows = shadows;
    quality.errorPixels = 0;
    quality.maxTriangles.reset();
    frame::PreparedFrame fine =
        renderer.prepare(frame.plan.view, quality, frame::Waiting::UntilComplete, frame.before.memory());
    fine.usesHeadlight = frame.usesHeadlight;
    return fine;
}

/// Draws and returns the picture of the finest level of detail with ray-traced shadows. For GroundTruth::FullDetail,
/// throws Error if pages of this level are missing.
render::Picture finestPicture(frame::Renderer& renderer, const frame::Frame& frame, GroundTruth groundTruth) {
    frame::PreparedFrame fine = finest(renderer, frame, plan::ShadowMode::Rays);
    std::optional<RayMemory> memory;
    if (groundTruth == GroundTruth::FullDetail) memory.emplace(renderer, fine);
    renderer.draw(fine, {});
    return renderer.backend().picture();
}

/// Traces shadow rays from the surfaces of `frame` against the finest level of detail. The frame must have been drawn
/// with its surfaces just before.
ShadowTruth truthOfFullDetail(frame::Renderer& renderer, const frame::Frame& frame, const render::DrawInputs& drawing) {
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    // The frame is prepared with exact shadows, because such a frame has no ray-tracing trees per page. Here, one scene
    // contains all triangles.
    const frame::PreparedFrame fine = finest(renderer, frame, plan::ShadowMode::Exact);
    const RayMemory memory(renderer, fine);
    const raytrace::Scene scene = render::rayScene(drawing, listsOf(fine));
    // The error limit of the drawn clusters bounds the distance between the drawn surface and the true surface.
    const auto light =
        render::lightByRays(scene, drawing, surfaces, std::max(render::kContactTolerancePixels, frame.errorPixels));
    return shadowTruth(scene, drawing, surfaces, light);
}

/// Traces shadow rays from the surfaces of `frame` against the clusters that its shadow maps draw. The frame must have
/// been drawn with its surfaces just before.
ShadowTruth truthOfSameDetail(
    const frame::Renderer& renderer, const frame::Frame& frame, const render::DrawInputs& drawing) {
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    // The error rule is the same as for the shadow maps, so the same clusters are selected, only in a larger volume.
    const std::array volumes = {frame.volumes[0], frame::rayCasterVolume(frame)};
    lod::CutQuery wider = frame::cutQuery(renderer.residency(), frame);
    wider.volumes = volumes;
    wider.sectionVolumes = 0;
    const lod::Cut cut = lod::cut(wider);
    const std::array lists = {drawing.image, &cut.lists.casters[0]};
    const raytrace::Scene scene = render::rayScene(drawing, lists);
    const auto light = render::lightByRays(scene, drawing, surfaces, render::kContactTolerancePixels);
    return shadowTruth(scene, drawing, surfaces, light);
}

/// Computes the status of each pixel of `frame` by exact integer shadows of all its selected clusters. The frame must
/// have been drawn just before.
render::Raster<std::uint8_t> trueStatuses(
    const frame::Renderer& renderer, const frame::Frame& frame, render::DrawInputs drawing) {
    const std::array volumes = {frame.volumes[0], frame::rayCasterVolume(frame)};
    lod::CutQuery wider = frame::cutQuery(renderer.residency(), frame);
    wider.volumes = volumes;
    wider.sectionVolumes = 0;
    const lod::Cut cut = lod::cut(wider);
    drawing.exactCasters = &cut.lists.casters[0];
    return render::statusesByIntegers(drawing);
}

/// Returns the share of all pixels whose lit or dark result in `surfaces` differs from `statuses`.
double wrongPixels(
    const render::Raster<render::SurfaceSample>& surfaces, const render::Raster<std::uint8_t>& statuses) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < statuses.pixels.size(); ++i) {
        const render::SurfaceSample& surface = surfaces.pixels[i];
        const bool isLit = surface.isLitSide() && surface.litFraction() >= 0.5F;
        const std::uint8_t status = statuses.pixels[i];
        wrong += isLit != (status != render::kNoSample && !exact::isDark(status)) ? 1U : 0U;
    }
    return static_cast<double>(wrong) / static_cast<double>(statuses.pixels.size());
}

/// Draws the frame before `now` again and compares the shadows of both frames. `maps` are the shadow maps of `now`. The
/// plan of the earlier frame does not change if its own view is planned again.
Crawl crawlSince(
    frame::Renderer& renderer,
    const plan::PlannedFrame& before,
    const render::DrawInputs& now,
    const render::FloatPicture& maps) {
    frame::PreparedFrame prepared =
        renderer.prepare(before.plan.view, before.plan.quality, frame::Waiting::UntilComplete, before.memory);
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    options.wantsWholeMaps = true;
    const render::DrawInputs then = renderer.drawing(prepared, options);
    renderer.draw(prepared, options);
    const render::FloatPicture thenMaps = renderer.backend().shadowDepth();
    return crawl({&then, &thenMaps}, renderer.backend().surfaces(), {&now, &maps});
}

/// Measures the shadows in `surfaces`, which `drawn` has drawn for `frame`: the share of wrong pixels if `isCompared`,
/// and the class of each pixel if `options` request it.
void compareWithIntegers(
    const frame::Renderer& renderer,
    const frame::Frame& frame,
    const render::DrawInputs& drawn,
    const ValidationOptions& options,
    bool isCompared,
    FrameValidation& proof) {
    if (!isCompared && !options.classifiesPixels) return;
    const render::Raster<render::SurfaceSample> surfaces = renderer.backend().surfaces();
    if (options.classifiesPixels) proof.classes = drawnClasses(surfaces);
    if (!isCompared) return;
    const render::Raster<std::uint8_t> statuses = trueStatuses(renderer, frame, drawn);
    proof.wrongPixelsAll = wrongPixels(surfaces, statuses);
    if (options.classifiesPixels && options.groundTruth == GroundTruth::Exact)
        proof.classes = trueClasses(surfaces, statuses);
}

} // namespace

FrameValidation validate(frame::Renderer& renderer, const frame::Frame& frame, const ValidationOptions& options) {
    const bool hasMaps = !frame.plan.passes.empty();
    const bool isCompared = (options.countsWrongPixels || options.groundTruth == GroundTruth::Exact) &&
                            (hasMaps || frame.hasOneCasterList());
    const bool hasGroundTruth =
        options.groundTruth != GroundTruth::None && options.groundTruth != GroundTruth::Exact && hasMaps;
    const bool isMeasured = options.measuresAliasing && hasMaps;
    const bool hasCrawl =
        options.measuresCrawl && hasMaps && frame.before.previous && !frame.before.previous->plan.passes.empty();
    FrameValidation proof;
    if (frame.options.observerCamera || !(hasGroundTruth || isCompared || isMeasured || hasCrawl ||
                                          options.comparesWithFinest || options.classifiesPixels))
        return proof;
    render::Backend& backend = renderer.backend();
    frame::FrameOptions plain = frame.options;
    plain.overlay = render::Overlay::None;
    plain.wantsSurfaces = hasGroundTruth || isCompared || isMeasured || hasCrawl || options.classifiesPixels;
    plain.wantsWholeMaps = hasCrawl;
    frame::PreparedFrame again = static_cast<const frame::PreparedFrame&>(frame);
    renderer.draw(again, plain, frame.history.maps);
    const render::DrawInputs drawn = renderer.drawing(again, plain);
    const render::Picture picture = backend.picture();
    const render::FloatPicture maps = hasCrawl ? backend.shadowDepth() : render::FloatPicture();
    if (isMeasured) proof.aliasing = measuredAliasing(drawn, backend.surfaces());
    if (hasGroundTruth)
        proof.truth = options.groundTruth == GroundTruth::FullDetail ? truthOfFullDetail(renderer, frame, drawn)
                                                                     : truthOfSameDetail(renderer, frame, drawn);
    compareWithIntegers(renderer, frame, drawn, options, isCompared, proof);
    if (options.comparesWithFinest)
        proof.imageDifference = render::difference(finestPicture(renderer, frame, options.groundTruth), picture).mean;
    if (hasCrawl) proof.crawl = crawlSince(renderer, *frame.before.previous, drawn, maps);
    // Restores the requested frame, so that its picture and its pages are available again.
    again = renderer.prepare(
        frame.plan.view, frame.plan.quality, frame.options.waiting, frame.before.memory(), frame.options.margin());
    again.usesHeadlight = frame.usesHeadlight;
    renderer.draw(again, frame.options);
    return proof;
}

void setAccuracy(const FrameValidation& proof, telemetry::FrameRow& row) {
    row.measuredAliasing = proof.aliasing ? std::optional(proof.aliasing->worst()) : std::nullopt;
    row.wrongShadowFraction = proof.truth ? std::optional(proof.truth->answerable.wrongFraction) : std::nullopt;
    row.shadowEdgeP99Px = proof.truth ? std::optional(proof.truth->answerable.edgeP99Pixels) : std::nullopt;
    row.missedShadowFraction = proof.truth ? std::optional(proof.truth->missedFraction()) : std::nullopt;
    row.unexplainedShadowFraction = proof.truth ? std::optional(proof.truth->unexplainedFraction()) : std::nullopt;
    row.imageDifference = proof.imageDifference;
    row.wrongPixelsAll = proof.wrongPixelsAll;
    row.crawl = proof.crawl ? std::optional(proof.crawl->share()) : std::nullopt;
}

} // namespace gnomon::validation
