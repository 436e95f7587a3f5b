#include "executor/software_executor.h"

#include "core/stopwatch.h"
#include "executor/exact_pass.h"
#include "executor/frame_block.h"
#include "executor/ray_pass.h"
#include "plan/cell_maps.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::executor {

namespace {

class SoftwareExecutor final : public Executor {
public:
    std::string name() const override { return "software"; }

    PassStatistics drawShadowMaps(const FrameDrawing& frame) override;

    PassStatistics drawImage(const FrameDrawing& frame) override;

    bool decidesExactly() const override { return true; }

    DrawStatistics drawExactly(const FrameDrawing& frame) override;

    Bytes deviceMemory() const override {
        return {shadowDepth_.pixels.size() * sizeof(float) + words_.size() * sizeof(std::uint64_t) + exact_.bytes()};
    }

    Picture picture() override { return picture_; }

    FloatPicture viewDepth() override;

    FloatPicture shadowDepth() override { return shadowDepth_; }

    Raster<SurfaceSample> surfaces() override { return surfaces_; }

private:
    void clearBetweenMaps(const plan::FramePlan& plan);
    void sizeTargets(const FrameDrawing& frame);
    void shade(const FrameDrawing& frame);
    void lightDecided(const FrameDrawing& frame, std::span<const std::uint8_t> statuses);

    raster::Rasterizer rasterizer_;
    SoftwarePass pass_;                // the one that is drawn
    std::vector<std::uint64_t> words_; // the visibility buffer, rows from bottom to top
    FloatPicture shadowDepth_;
    Picture picture_;
    Raster<SurfaceSample> surfaces_;
    double clipNear_ = 1;
    exact::ExactShadows exact_;
    UndecidedPixels undecided_;
};

/// What no map covers is 1; each map clears its own texels as it is drawn.
void SoftwareExecutor::clearBetweenMaps(const plan::FramePlan& plan) {
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

PassStatistics SoftwareExecutor::drawShadowMaps(const FrameDrawing& frame) {
    const Stopwatch watch;
    const plan::FramePlan& plan = *frame.plan;
    PassStatistics statistics{{}, 0, 0};
    if (plan.passes.empty()) {
        shadowDepth_ = {};
        return statistics;
    }
    if (shadowDepth_.width != plan.textureWidth || shadowDepth_.height != plan.textureHeight)
        shadowDepth_ = FloatPicture(plan.textureWidth, plan.textureHeight);
    clearBetweenMaps(plan);
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        if (plan.passes[p].isReused) continue;
        const shadow::TexelRectangle& r = plan.passes[p].map.rectangle;
        const MapDrawing map = mapDrawing(frame, plan.passes[p].map);
        pass_.gather(frame, *frame.casters[p]);
        statistics.drawCalls += frame.casters[p]->ranges.size();
        *statistics.fragments += rasterizer_.drawDepth(
            pass_.clusters(),
            rasterView(map.space, map.clipFromDraw(), {r.x, r.y, r.x + r.width, r.y + r.height}),
            {shadowDepth_.pixels.data(), shadowDepth_.width, shadowDepth_.height});
    }
    statistics.time = watch.elapsed();
    return statistics;
}

void SoftwareExecutor::sizeTargets(const FrameDrawing& frame) {
    clipNear_ = frame.clipNear;
    const plan::View& view = frame.plan->view;
    if (picture_.width != view.width || picture_.height != view.height) picture_ = Picture(view.width, view.height);
    if (!frame.wantsSurfaces)
        surfaces_ = {};
    else if (surfaces_.width != view.width || surfaces_.height != view.height)
        surfaces_ = Raster<SurfaceSample>(view.width, view.height);
    words_.resize(picture_.pixels.size());
}

/// From the words of the image to its colours, and to the surfaces where they are wanted.
void SoftwareExecutor::shade(const FrameDrawing& frame) {
    const Shading shading(frame, imageClipFromDraw(frame), shadowDepth_, pass_.drawn());
    shadeVisible(shading, words_, {&picture_, frame.wantsSurfaces ? &surfaces_ : nullptr});
}

PassStatistics SoftwareExecutor::drawImage(const FrameDrawing& frame) {
    const Stopwatch watch;
    sizeTargets(frame);
    drawVisible(frame, {&rasterizer_, &pass_, &words_, &picture_});
    shade(frame);
    return {watch.elapsed(), frame.image->ranges.size(), std::nullopt};
}

/// Gives the light to the samples that it reaches by their `statuses`; where more than colours is wanted, by shading
/// once more.
void SoftwareExecutor::lightDecided(const FrameDrawing& frame, std::span<const std::uint8_t> statuses) {
    const exact::SampleList& samples = exact_.samples();
    const bool isShadedAgain = frame.overlay != Overlay::None || frame.wantsSurfaces;
    if (!isShadedAgain) {
        constexpr std::size_t kGrain = 16384;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                if (exact::isDark(statuses[i])) continue;
                const std::uint32_t color = samples.color[i];
                picture_.pixels[samples.pixel[i]] = {
                    static_cast<std::uint8_t>(color),
                    static_cast<std::uint8_t>(color >> 8U),
                    static_cast<std::uint8_t>(color >> 16U)};
            }
        });
        return;
    }
    Raster<std::uint8_t> mask(picture_.width, picture_.height);
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (!exact::isDark(statuses[i])) mask.pixels[samples.pixel[i]] = 255;
    FrameDrawing lit = frame;
    lit.litMask = &mask;
    shade(lit);
}

DrawStatistics SoftwareExecutor::drawExactly(const FrameDrawing& frame) {
    const Stopwatch watch;
    DrawStatistics statistics;
    shadowDepth_ = {};
    sizeTargets(frame);
    drawUndecided(frame, {&rasterizer_, &pass_, &words_, &picture_}, exact_.samples(), undecided_);
    statistics.image = {watch.elapsed(), frame.image->ranges.size(), std::nullopt};
    const Stopwatch shadowWatch;
    if (frame.rays != nullptr) {
        lightDecided(frame, tracedStatuses(frame, *frame.rays, exact_.samples(), pass_.drawn()));
    } else {
        const std::vector<exact::Caster> casters = exactCasters(frame, pass_);
        const std::vector<glm::dmat3> planes = cellPlanes(frame, exact_.samples().space().shear);
        const hierarchy::GridPoint origin = frame.space.originCell;
        statistics.exact =
            exact_.decide({casters, {origin.x, origin.y, origin.z}, planes, plan::cellSide(*frame.plan)});
        lightDecided(frame, exact_.statuses());
    }
    statistics.shadows = {shadowWatch.elapsed(), 0, std::nullopt};
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

FloatPicture SoftwareExecutor::viewDepth() {
    FloatPicture result(picture_.width, picture_.height);
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column) {
            const std::uint64_t word = words_[result.index(column, result.height - 1 - row)];
            // Infinite where nothing was drawn.
            result.at(column, row) = static_cast<float>(clipNear_ / static_cast<double>(raster::visibleDepth(word)));
        }
    return result;
}

} // namespace

std::unique_ptr<Executor> makeSoftwareExecutor() {
    return std::make_unique<SoftwareExecutor>();
}

} // namespace gnomon::executor
