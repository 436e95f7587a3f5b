#include "render/software_backend.h"

#include "core/check.h"
#include "core/stopwatch.h"
#include "plan/cell_maps.h"
#include "render/exact_pass.h"
#include "render/frame_block.h"
#include "render/light/background.h"
#include "render/ray_pass.h"
#include "render/software/receiver_pass.h"
#include "render/view/image_projection.h"
#include "render/view/section_caps.h"
#include "render/view/seen_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace gnomon::render {

namespace {

class SoftwareBackend final : public Backend {
public:
    std::string name() const override { return "software"; }

    PassStatistics drawShadowMaps(const DrawInputs& frame) override;

    PassStatistics drawImage(const DrawInputs& frame) override;

    DrawStatistics draw(const DrawInputs& frame) override;

    plan::Capabilities capabilities() const override { return plan::kSoftwareCapabilities; }

    DrawStatistics drawExactly(const DrawInputs& frame) override;

    Bytes deviceMemory() const override {
        return {
            shadowDepth_.pixels.size() * sizeof(float) + words_.size() * sizeof(std::uint64_t) + exact_.bytes() +
            receivers_.bytes() + light_.pixels.size() * sizeof(light_.pixels[0]) + litMask_.pixels.size()};
    }

    Picture picture() override;

    Coverage coverage() override;

    LightPicture light() override { return light_; }

    std::optional<std::uint64_t> litPixels() override { return litPixels_; }

    FloatPicture viewDepth() override;

    FloatPicture shadowDepth() override;

    Raster<SurfaceSample> surfaces() override { return surfaces_; }

    Raster<SeenTriangle> seenTriangles() const override {
        return render::seenTriangles(picture_.width, picture_.height, words_, pass_.drawn());
    }

private:
    void sizeShadowDepth(const plan::FramePlan& plan);
    void clearBetweenMaps(const plan::FramePlan& plan);
    void drawMap(
        const DrawInputs& frame, const lod::DrawList& casters, const raster::View& view, PassStatistics& statistics);
    raster::OcclusionCounts drawWantedMap(
        const DrawInputs& frame, const lod::DrawList& casters, const raster::View& view, PassStatistics& statistics);

    raster::DepthTarget depthTarget() { return {shadowDepth_.pixels.data(), shadowDepth_.width, shadowDepth_.height}; }

    CulledCasters drawCulledMaps(const DrawInputs& frame, PassStatistics& statistics);
    void sizeTargets(const DrawInputs& frame);

    ImageBuffers imageBuffers() { return {&rasterizer_, &pass_, &words_, &picture_}; }

    void shade(const DrawInputs& frame);
    void keepVerdict(std::span<const std::uint8_t> statuses);
    bool shadeDecided(const DrawInputs& frame);

    raster::Rasterizer rasterizer_;
    SoftwarePass mapPass_;             // clusters of the map that is being drawn
    SoftwarePass pass_;                // clusters of the image
    std::vector<std::uint64_t> words_; // visibility buffer, rows from bottom to top
    FloatPicture shadowDepth_;         // the pixel array never shrinks, so it can be larger than the texture
    Picture picture_;
    LightPicture light_;           // empty unless a frame requests its light
    Raster<std::uint8_t> litMask_; // result of exact shadows: 255 for lit pixels
    Raster<SurfaceSample> surfaces_;
    bool isOnGround(std::size_t wordAt) const;

    ImageDepth depth_;
    bool isTransparent_ = false;
    std::atomic<std::uint64_t> litPixels_{0};
    exact::ExactShadows exact_;
    std::vector<exact::Caster> casters_; // casters of exact shadows
    UnresolvedPixels unresolved_;
    ReceiverPass receivers_;
};

Cutting castersCutting(const DrawInputs& frame) {
    return frame.plan->view.cutsCasters ? Cutting::BySections : Cutting::Whole;
}

/// Clears all texels of the depth texture outside the shadow maps to 1. The texels of a map are cleared when the map is
/// drawn.
void SoftwareBackend::clearBetweenMaps(const plan::FramePlan& plan) {
    std::vector<shadow::TexelRectangle> row;
    for (int y = 0; y < shadowDepth_.height; ++y) {
        row.clear();
        for (const plan::ShadowPass& pass : plan.passes) {
            const shadow::TexelRectangle& r = pass.map.rectangle;
            if (r.y <= y && y < r.y + r.height) row.push_back(r);
        }
        std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
        row.push_back({shadowDepth_.width, 0, 0, 0, false});
        int end = 0;
        for (const shadow::TexelRectangle& r : row) {
            std::fill(&shadowDepth_.at(0, y) + end, &shadowDepth_.at(0, y) + std::max(end, r.x), 1.0F);
            end = std::max(end, r.x + r.width);
        }
    }
}

/// Resizes the depth texture of the shadow maps to the size in the plan. If the size changes, the content is undefined.
void SoftwareBackend::sizeShadowDepth(const plan::FramePlan& plan) {
    shadowDepth_.width = plan.textureWidth;
    shadowDepth_.height = plan.textureHeight;
    const std::size_t texels =
        static_cast<std::size_t>(plan.textureWidth) * static_cast<std::size_t>(plan.textureHeight);
    if (shadowDepth_.pixels.size() < texels) shadowDepth_.pixels.resize(texels);
}

void SoftwareBackend::drawMap(
    const DrawInputs& frame, const lod::DrawList& casters, const raster::View& view, PassStatistics& statistics) {
    mapPass_.gather(frame, casters, castersCutting(frame));
    statistics.drawCalls += casters.ranges.size();
    *statistics.fragments += rasterizer_.drawDepth(mapPass_.clusters(), view, depthTarget());
}

/// Draws a shadow map, but skips texels that no receiver looks up and casters that other casters hide from the light.
/// Returns the counts of skipped casters.
raster::OcclusionCounts SoftwareBackend::drawWantedMap(
    const DrawInputs& frame, const lod::DrawList& casters, const raster::View& view, PassStatistics& statistics) {
    mapPass_.gather(frame, casters, castersCutting(frame));
    statistics.drawCalls += casters.ranges.size();
    raster::DepthTarget target = depthTarget();
    target.isWanted = [this](const raster::PixelBox& box) { return !receivers_.isUnseen(box); };
    const raster::NearestDepths drawn =
        rasterizer_.drawNearestDepth(mapPass_.clusters(), mapPass_.boxes(), view, target);
    *statistics.fragments += drawn.fragments;
    return drawn.hidden;
}

PassStatistics SoftwareBackend::drawShadowMaps(const DrawInputs& frame) {
    const Stopwatch watch;
    const plan::FramePlan& plan = *frame.plan;
    PassStatistics statistics{{}, 0, 0};
    if (plan.passes.empty()) {
        if (plan.quality.shadows != plan::ShadowMode::Maps) shadowDepth_ = {};
        shadowDepth_.width = shadowDepth_.height = 0;
        return statistics;
    }
    sizeShadowDepth(plan);
    clearBetweenMaps(plan);
    for (std::size_t p = 0; p < plan.passes.size(); ++p)
        if (!plan.passes[p].isReused)
            drawMap(frame, *frame.casters[p], MapView(frame, plan.passes[p].map).view, statistics);
    statistics.time = watch.elapsed();
    return statistics;
}

/// Draws the texels of all shadow maps that receivers look up. Returns the numbers of tested and drawn casters.
CulledCasters SoftwareBackend::drawCulledMaps(const DrawInputs& frame, PassStatistics& statistics) {
    CulledCasters culled;
    for (std::size_t p = 0; p < frame.plan->passes.size(); ++p) {
        if (frame.plan->passes[p].isReused) continue;
        const MapView map(frame, frame.plan->passes[p].map);
        const raster::View& view = map.view;
        if (receivers_.isUnseen(view.viewport)) continue;
        const lod::DrawList& casters = receivers_.casters(frame, p, view);
        const raster::OcclusionCounts hidden = drawWantedMap(frame, casters, view, statistics);
        culled.clustersKept += casters.clusters - hidden.clustersHidden;
        culled.triangles += casters.triangles - hidden.trianglesHidden;
        ++culled.mapsDrawn;
    }
    culled.clustersTested = receivers_.clustersTested();
    return culled;
}

DrawStatistics SoftwareBackend::draw(const DrawInputs& frame) {
    if (!frame.cullsByReceivers || frame.plan->passes.empty()) return Backend::draw(frame);
    Stopwatch watch;
    DrawStatistics statistics;
    sizeTargets(frame);
    sizeShadowDepth(*frame.plan);
    GNOMON_CHECK(!frame.wantsLight); // stored light needs maps that are drawn before the image
    const ImageBuffers buffers = imageBuffers();
    const auto occlusion = drawVisible(frame, buffers);
    litPixels_ = receivers_.collect(frame, buffers, shadowDepth_);
    const Milliseconds before = watch.elapsed();
    statistics.shadows = {{}, 0, 0};
    statistics.culled = drawCulledMaps(frame, statistics.shadows);
    statistics.shadows.time = {watch.elapsed().count - before.count};
    if (receivers_.canLight())
        litPixels_ += receivers_.light(shadowDepth_, picture_);
    else
        shade(frame);
    statistics.image = {
        {watch.elapsed().count - statistics.shadows.time.count}, frame.image->ranges.size(), std::nullopt, occlusion};
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

void SoftwareBackend::sizeTargets(const DrawInputs& frame) {
    depth_ = imageProjection(frame).depth;
    isTransparent_ = isTransparent(frame);
    const int width = frame.plan->view.width;
    const int height = rowsOf(frame).count;
    const auto fit = [&](auto& raster) {
        if (raster.width != width || raster.height != height) raster = {width, height};
    };
    fit(picture_);
    if (frame.wantsSurfaces)
        fit(surfaces_);
    else
        surfaces_ = {};
    words_.resize(picture_.pixels.size());
    if (frame.wantsLight)
        fit(light_);
    else
        light_ = {};
}

/// Shades the visibility buffer: computes the colours of the image. If the frame requests surfaces, also computes the
/// surface of each pixel.
void SoftwareBackend::shade(const DrawInputs& frame) {
    const Shading shading(frame, imageClipFromDraw(frame), shadowDepth_, pass_.drawn());
    litPixels_ = 0;
    ShadingTarget target;
    target.picture = &picture_;
    target.surfaces = frame.wantsSurfaces ? &surfaces_ : nullptr;
    target.litPixels = &litPixels_;
    target.light = frame.wantsLight ? &light_ : nullptr;
    target.tiles = frame.tiles;
    shadeVisible(shading, words_, target);
}

PassStatistics SoftwareBackend::drawImage(const DrawInputs& frame) {
    const Stopwatch watch;
    sizeTargets(frame);
    const auto occlusion = drawVisible(frame, imageBuffers());
    shade(frame);
    return {watch.elapsed(), frame.image->ranges.size(), std::nullopt, occlusion};
}

/// Converts the shadow results of the samples to a mask with 255 for each lit pixel.
void SoftwareBackend::keepVerdict(std::span<const std::uint8_t> statuses) {
    const exact::SampleList& samples = exact_.samples();
    litMask_.width = picture_.width;
    litMask_.height = picture_.height;
    litMask_.pixels.assign(picture_.pixels.size(), 0);
    litPixels_ = 0;
    constexpr std::size_t kGrain = 16384;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), [&](const auto& range) {
        std::uint64_t lit = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (exact::isDark(statuses[i])) continue;
            litMask_.pixels[samples.pixel[i]] = 255;
            ++lit;
        }
        litPixels_.fetch_add(lit, std::memory_order_relaxed);
    });
}

/// Shades the image with the mask of lit pixels. Uses the headlight if too few pixels are lit, and then returns true.
bool SoftwareBackend::shadeDecided(const DrawInputs& frame) {
    const std::uint64_t lit = litPixels_;
    DrawInputs decided = frame;
    decided.litMask = &litMask_;
    const bool isHeadlit = lit < frame.minLitPixels.value_or(0);
    if (isHeadlit) decided.shading = plan::Shading::Headlight;
    shade(decided);
    litPixels_ = lit; // number of lit samples; the count of the shading is not used
    return isHeadlit;
}

DrawStatistics SoftwareBackend::drawExactly(const DrawInputs& frame) {
    const Stopwatch watch;
    DrawStatistics statistics;
    shadowDepth_ = {};
    sizeTargets(frame);
    const auto occlusion = collectSamples(frame, imageBuffers(), exact_.samples(), unresolved_);
    const Stopwatch shadowWatch;
    if (frame.rays != nullptr) {
        keepVerdict(tracedStatuses(frame, *frame.rays, exact_.samples(), pass_.drawn()));
    } else {
        gatherExactCasters(frame, pass_, casters_);
        const std::vector<glm::dmat3> planes = cellPlanes(frame, exact_.samples().space().shear);
        const hierarchy::GridPoint origin = frame.space.originCell;
        statistics.exact =
            exact_.resolve({casters_, {origin.x, origin.y, origin.z}, planes, plan::cellSide(*frame.plan)});
        keepVerdict(exact_.statuses());
    }
    statistics.shadows = {shadowWatch.elapsed(), 0, std::nullopt};
    statistics.isHeadlit = shadeDecided(frame);
    const Milliseconds image{watch.elapsed().count - statistics.shadows.time.count};
    statistics.image = {image, frame.image->ranges.size(), std::nullopt, occlusion};
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

FloatPicture SoftwareBackend::shadowDepth() {
    FloatPicture result = shadowDepth_;
    result.pixels.resize(result.index(0, result.height));
    return result;
}

/// Returns true if the pixel at index `wordAt` of the visibility buffer shows the ground.
bool SoftwareBackend::isOnGround(std::size_t wordAt) const {
    const std::uint64_t word = words_[wordAt];
    if (word == 0 || isCapName(raster::visibleTriangle(word))) return false;
    return pass_.drawn()[raster::visibleTriangle(word) >> kTriangleBits].isGround;
}

/// Returns the colours of the image. With a transparent background, the ground was drawn as a shadow on white. The
/// darkness of the shadow then determines the coverage, and the colour becomes black.
Picture SoftwareBackend::picture() {
    Picture result = picture_;
    if (!isTransparent_ || !pass_.hasGround()) return result;
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column)
            if (isOnGround(result.index(column, result.height - 1 - row))) result.at(column, row) = {};
    return result;
}

Coverage SoftwareBackend::coverage() {
    Coverage result = coverageOf(viewDepth());
    if (!pass_.hasGround()) return result;
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column)
            if (isOnGround(result.index(column, result.height - 1 - row)))
                result.at(column, row) = static_cast<std::uint8_t>(255 - picture_.at(column, row)[0]);
    return result;
}

FloatPicture SoftwareBackend::viewDepth() {
    FloatPicture result(picture_.width, picture_.height);
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column) {
            const std::size_t at = result.index(column, result.height - 1 - row);
            // The view depth is infinite if no surface of the model is visible at the pixel.
            const bool isShown = !pass_.hasGround() || !isOnGround(at);
            result.at(column, row) =
                static_cast<float>(depth_.asked(isShown ? raster::visibleDepth(words_[at]) : 0.0F));
        }
    return result;
}

} // namespace

std::unique_ptr<Backend> makeSoftwareBackend() {
    return std::make_unique<SoftwareBackend>();
}

} // namespace gnomon::render
