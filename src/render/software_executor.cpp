#include "render/software_executor.h"

#include "raster/raster.h"
#include "render/frame_block.h"
#include "render/software_shading.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

namespace gnomon::render {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

static_assert(raster::kMaxClusterTriangles == 1U << kTriangleBits);

/// A pass as the rasteriser takes it: the same matrix as the shaders', with the grid's step inside.
raster::View rasterView(const DrawSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport) {
    raster::View view;
    view.eyeCell = glm::ivec3(space.originCell.x, space.originCell.y, space.originCell.z);
    view.clipFromCell = glm::mat4(clipFromDraw);
    for (int axis = 0; axis < 3; ++axis)
        view.clipFromCell[axis] *= static_cast<float>(space.step); // a power of two: exact
    view.viewport = viewport;
    return view;
}

class SoftwareExecutor final : public Executor {
public:
    std::string name() const override { return "software"; }

    DrawStatistics draw(const FrameDrawing& frame) override;

    Picture picture() override { return picture_; }

    FloatPicture viewDepth() override;

    FloatPicture shadowDepth() override { return shadowDepth_; }

    Raster<SurfaceSample> surfaces() override { return surfaces_; }

private:
    void gather(const FrameDrawing& frame, const selection::DrawList& list);
    void drawShadowMaps(const FrameDrawing& frame);
    void drawImage(const FrameDrawing& frame);

    raster::Rasterizer rasterizer_;
    std::vector<raster::Cluster> clusters_; // of the pass that is drawn
    std::vector<VisibleCluster> visible_;   // the same, as shading wants them
    std::vector<std::uint64_t> words_;      // the visibility buffer, rows from bottom to top
    FloatPicture shadowDepth_;
    Picture picture_;
    Raster<SurfaceSample> surfaces_;
    double clipNear_ = 1;
    std::uint64_t drawCalls_ = 0;
};

DrawStatistics SoftwareExecutor::draw(const FrameDrawing& frame) {
    DrawStatistics statistics;
    drawCalls_ = 0;
    clipNear_ = frame.clipNear;
    const auto start = Clock::now();
    drawShadowMaps(frame);
    statistics.shadowMs = frame.plan->passes.empty() ? 0 : millisecondsSince(start);
    const auto imageStart = Clock::now();
    drawImage(frame);
    statistics.imageMs = millisecondsSince(imageStart);
    statistics.drawCalls = drawCalls_;
    statistics.deviceBytes = shadowDepth_.pixels.size() * sizeof(float) + words_.size() * sizeof(std::uint64_t);
    return statistics;
}

void SoftwareExecutor::gather(const FrameDrawing& frame, const selection::DrawList& list) {
    clusters_.clear();
    visible_.clear();
    for (const selection::ClusterRange& range : list.ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        ++drawCalls_;
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const hierarchy::Cluster& cluster = page.clusters[c];
            clusters_.push_back(
                {&page.vertices[cluster.firstVertex].position.x,
                 sizeof(hierarchy::Vertex),
                 cluster.vertexCount,
                 std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount),
                 static_cast<std::uint32_t>(visible_.size()) << kTriangleBits});
            visible_.push_back({&page, range.page, c});
        }
    }
}

void SoftwareExecutor::drawShadowMaps(const FrameDrawing& frame) {
    const plan::FramePlan& plan = *frame.plan;
    if (plan.passes.empty()) {
        shadowDepth_ = {};
        return;
    }
    if (shadowDepth_.width != plan.textureWidth || shadowDepth_.height != plan.textureHeight)
        shadowDepth_ = FloatPicture(plan.textureWidth, plan.textureHeight);
    std::fill(shadowDepth_.pixels.begin(), shadowDepth_.pixels.end(), 1.0F); // what no map covers
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        const plan::Rectangle& r = plan.passes[p].rectangle;
        gather(frame, *frame.casters[p]);
        rasterizer_.drawDepth(
            clusters_,
            rasterView(
                frame.space,
                shadowClipFromDraw(plan.passes[p], frame.space),
                {r.x, r.y, r.x + r.width, r.y + r.height}),
            {shadowDepth_.pixels.data(), shadowDepth_.width, shadowDepth_.height});
    }
}

void SoftwareExecutor::drawImage(const FrameDrawing& frame) {
    const plan::View& view = frame.plan->view;
    picture_ = Picture(view.width, view.height, kBackground);
    surfaces_ = frame.wantsSurfaces ? Raster<SurfaceSample>(view.width, view.height) : Raster<SurfaceSample>();
    words_.resize(picture_.pixels.size());
    gather(frame, *frame.image);
    const glm::dmat4 clipFromDraw = imageClipFromDraw(frame);
    rasterizer_.drawVisibility(
        clusters_,
        rasterView(frame.space, clipFromDraw, {0, 0, view.width, view.height}),
        {words_.data(), view.width, view.height});
    const Shading shading(frame, clipFromDraw, shadowDepth_, visible_);
    tbb::parallel_for(0, view.height, [&](int row) {
        const int bottomUp = view.height - 1 - row;
        const auto width = static_cast<std::size_t>(view.width);
        shading.shadeRow(
            bottomUp,
            std::span(words_).subspan(picture_.index(0, bottomUp), width),
            &picture_.at(0, row),
            frame.wantsSurfaces ? &surfaces_.at(0, row) : nullptr);
    });
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

} // namespace gnomon::render
