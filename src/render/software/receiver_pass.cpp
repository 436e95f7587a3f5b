#include "render/software/receiver_pass.h"

#include "render/frame_block.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::render {

namespace {

/// Returns the group of `page` that contains `cluster`, by binary search. Groups are sorted by their clusters.
const hierarchy::Group& groupOf(const hierarchy::Page& page, std::uint32_t cluster) {
    const auto after = std::upper_bound(
        page.groups.begin(), page.groups.end(), cluster, [](std::uint32_t c, const hierarchy::Group& group) {
            return c < group.firstCluster;
        });
    return *std::prev(after);
}

raster::CellBox cells(const hierarchy::GridBox& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

/// Marks the clusters of `range` that may shadow a receiver according to `mayShadow`. The function tests whole groups
/// first.
template <class MayShadow>
void markRange(
    const hierarchy::Page& page,
    const lod::ClusterRange& range,
    const MayShadow& mayShadow,
    std::span<std::uint8_t> marks) {
    const std::uint32_t end = range.firstCluster + range.clusterCount;
    for (std::uint32_t c = range.firstCluster; c < end;) {
        const hierarchy::Group& group = groupOf(page, c);
        const std::uint32_t groupEnd = std::min(end, group.firstCluster + group.clusterCount);
        const bool isPossible = groupEnd - c == 1 || mayShadow(group.box);
        for (; c < groupEnd; ++c)
            marks[c - range.firstCluster] = isPossible && mayShadow(page.clusters[c].box) ? 1 : 0;
    }
}

} // namespace

std::uint64_t ReceiverPass::collect(
    const DrawInputs& frame, const ImageBuffers& buffers, const FloatPicture& shadowDepth) {
    clustersTested_ = 0;
    const bool isLitLater = frame.overlay == Overlay::None && !frame.wantsSurfaces && frame.plan->quality.filter <= 1;
    awaited_.isLitLater = isLitLater;
    awaited_.size = 0;
    const std::size_t pixelCount = isLitLater ? buffers.picture->pixels.size() : 0;
    if (awaited_.pixels.size() < pixelCount) {
        for (auto* values : {&awaited_.pixels, &awaited_.texels, &awaited_.litColors})
            values->resize(pixelCount);
        awaited_.depths.resize(pixelCount);
        awaited_.counts.resize(pixelCount);
    }
    awaited_.mask = &mask_;
    mask_.reset(shadowDepth.width, shadowDepth.height);
    const Shading shading(frame, imageClipFromDraw(frame), shadowDepth, buffers.pass->drawn(), Verdict::Awaited);
    ShadingTarget target;
    target.picture = buffers.picture;
    target.awaited = &awaited_;
    std::atomic<std::uint64_t> lit{0};
    target.litPixels = &lit;
    shadeVisible(shading, *buffers.words, target);
    mask_.finish();
    return lit;
}

const lod::DrawList& ReceiverPass::casters(const DrawInputs& frame, std::size_t pass, const raster::View& view) {
    const lod::DrawList& all = *frame.casters[pass];
    clustersTested_ += all.clusters;
    places_.clear();
    std::size_t count = 0;
    for (const lod::ClusterRange& range : all.ranges) {
        places_.push_back(count);
        count += range.clusterCount;
    }
    mayShadow_.resize(count);
    constexpr std::size_t kGrain = 16;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, all.ranges.size(), kGrain), [&](const auto& ranges) {
        for (std::size_t i = ranges.begin(); i < ranges.end(); ++i)
            markRange(
                frame.pages(all.ranges[i].page),
                all.ranges[i],
                [&](const hierarchy::GridBox& box) { return mask_.mayShadow(exact::casterBound(view, cells(box))); },
                std::span(mayShadow_).subspan(places_[i], all.ranges[i].clusterCount));
    });
    kept_.ranges.clear();
    kept_.clusters = kept_.triangles = 0;
    for (std::size_t i = 0; i < all.ranges.size(); ++i) {
        const lod::ClusterRange& range = all.ranges[i];
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = 0; c < range.clusterCount; ++c) {
            if (mayShadow_[places_[i] + c] == 0) continue;
            const bool isNext = c > 0 && mayShadow_[places_[i] + c - 1] != 0;
            if (isNext)
                ++kept_.ranges.back().clusterCount;
            else
                kept_.ranges.push_back({range.page, range.firstCluster + c, 1});
            ++kept_.clusters;
            kept_.triangles += page.clusters[range.firstCluster + c].triangleCount;
        }
    }
    return kept_;
}

std::uint64_t ReceiverPass::light(const FloatPicture& shadowDepth, Picture& picture) const {
    constexpr std::size_t kGrain = 1 << 14;
    std::atomic<std::uint64_t> lit{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, awaited_.size, kGrain), [&](const auto& range) {
        std::uint64_t count = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (awaited_.depths[i] > shadowDepth.pixels[awaited_.texels[i]]) continue;
            picture.pixels[awaited_.pixels[i]] = unpacked(awaited_.litColors[i]);
            count += awaited_.counts[i];
        }
        lit.fetch_add(count, std::memory_order_relaxed);
    });
    return lit;
}

} // namespace gnomon::render
