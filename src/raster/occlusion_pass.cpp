#include "raster/occlusion_pass.h"

#include "core/check.h"
#include "raster/tile_kernel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <thread>
#include <type_traits>

namespace gnomon::raster {
namespace {

constexpr unsigned kDigitBits = 10; // bits per digit of the radix sort; three digits contain the bits of 1.0F

/// Returns the depth that a pixel stores for the unclamped depth `z`.
float clampedDepth(float z) {
    return std::clamp(z, 0.0F, 1.0F);
}

PixelBox relativeTo(const PixelBox& tile, const PixelBox& box) {
    return {box.x0 - tile.x0, box.y0 - tile.y0, box.x1 - tile.x0, box.y1 - tile.y0};
}

} // namespace

void sortByUpperHalf(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& scratch) {
    scratch.resize(keys.size());
    for (unsigned digit = 0; digit < 3; ++digit) {
        const unsigned shift = 32 + digit * kDigitBits;
        const auto digitOf = [shift](std::uint64_t key) {
            return static_cast<std::size_t>(key >> shift & ((1U << kDigitBits) - 1));
        };
        std::array<std::size_t, (std::size_t{1} << kDigitBits) + 1> first{};
        for (const std::uint64_t key : keys)
            ++first[digitOf(key) + 1];
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        for (const std::uint64_t key : keys)
            scratch[first[digitOf(key)]++] = key;
        keys.swap(scratch);
    }
}

void OcclusionPass::prepare(
    std::span<const Cluster> input,
    std::span<const CellBox> boxes,
    const Projection& projection,
    const PixelBox& viewport,
    DepthOrder order,
    SnappedClusters& snapped) {
    GNOMON_CHECK_OP(boxes.size(), ==, input.size());
    order_ = order;
    input_ = input;
    projection_ = projection;
    snapped_ = &snapped;
    snapped.reset(input);
    stages_ = stageBuffer_.reserve(input.size());
    bounds_.resize(input.size());
    boundClusters(boxes);
    snapped.addCuts();
    orderItems(viewport);
    const std::size_t words = snapped.all().size() * TriangleBits().size();
    setUpBits_ = setUp_.reserve(words);
    for (std::size_t i = 0; i < words; ++i)
        setUpBits_[i].store(0, std::memory_order_relaxed);
}

void OcclusionPass::boundClusters(std::span<const CellBox> boxes) {
    constexpr std::size_t kGrain = 256;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, input_.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            bounds_[i] = boxBound(projection_, boxes[i]);
            stages_[i].store(bounds_[i].isWhole ? Stage::Waiting : Stage::Snapped, std::memory_order_relaxed);
            if (!bounds_[i].isWhole) snapped_->snap(input_, i, projection_);
        }
    });
}

/// Returns an upper bound of the nearness (an integer that is larger for nearer depths) of cluster `i`. The cluster is
/// a cluster of the pass or a cluster of clipped triangles.
std::uint32_t OcclusionPass::nearnessOf(std::size_t i) const {
    if (order_ == DepthOrder::Plain) return isBounded(i) ? plainNearness(bounds_[i].min) : plainNearness(0);
    return reversedNearness(isBounded(i) ? bounds_[i].nearest : clampedDepth(snapped_->all()[i].maxZ));
}

void OcclusionPass::orderItems(const PixelBox& viewport) {
    const std::span<const SnappedCluster> all = snapped_->all();
    const auto boxOf = [&](std::size_t i) { return isBounded(i) ? bounds_[i].box : all[i].box; };
    keys_.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (intersection(boxOf(i), viewport).empty()) continue;
        const std::uint32_t behind = reversedNearness(1) - nearnessOf(i);
        keys_.push_back(std::uint64_t{behind} << 32U | i);
    }
    sortByUpperHalf(keys_, scratch_);
    items_.clear();
    drawn_.clear();
    for (const std::uint64_t key : keys_) {
        const auto i = static_cast<std::uint32_t>(key);
        const std::size_t triangles = i < input_.size() ? input_[i].triangles.size() : all[i].triangles.size();
        items_.push_back({boxOf(i), static_cast<std::uint32_t>(triangles)});
        drawn_.push_back({i, nearnessOf(i)});
    }
}

/// Snaps the vertices of a cluster before its first use. The first thread that needs the cluster does the work, and
/// other threads wait for less than a microsecond.
void OcclusionPass::requireSnapped(std::uint32_t cluster) {
    if (cluster >= input_.size() || stages_[cluster].load(std::memory_order_acquire) == Stage::Snapped) return;
    Stage expected = Stage::Waiting;
    if (stages_[cluster].compare_exchange_strong(expected, Stage::InWork, std::memory_order_relaxed)) {
        GNOMON_CHECK(snapped_->snap(input_, cluster, projection_) != ClusterPlace::Cut);
        stages_[cluster].store(Stage::Snapped, std::memory_order_release);
        return;
    }
    while (stages_[cluster].load(std::memory_order_acquire) != Stage::Snapped)
        std::this_thread::yield();
}

/// Records the triangles of a cluster that passed triangle setup in a tile. Other tiles can record other triangles of
/// the same cluster.
void OcclusionPass::noteSetUp(std::uint32_t cluster, const TriangleBits& bits) {
    for (std::size_t i = 0; i < bits.size(); ++i)
        if (bits[i] != 0) setUpBits_[cluster * bits.size() + i].fetch_or(bits[i], std::memory_order_relaxed);
}

template <class Depths>
std::uint64_t OcclusionPass::drawOver(
    const PixelBox& tile, std::span<const std::uint32_t> indices, typename Depths::Pixel* pixels) {
    constexpr bool kIsMap = std::is_same_v<Depths, MapDepths>;
    FarthestDepths<Depths> depths(pixels, tile.width(), tile.height());
    const std::span<const SnappedCluster> all = snapped_->all();
    std::uint64_t covered = 0;
    for (const std::uint32_t index : indices) {
        const Drawn& drawn = drawn_[index];
        if (depths.hides(relativeTo(tile, intersection(items_[index].box, tile)), drawn.nearest)) continue;
        requireSnapped(drawn.cluster);
        const SnappedCluster& cluster = all[drawn.cluster];
        const PixelBox touched = intersection(cluster.box, tile);
        if (cluster.triangles.empty() || touched.empty()) continue;
        const PixelBox box = relativeTo(tile, touched);
        const TileWork work = {tile, all, {&drawn.cluster, 1}};
        if constexpr (kIsMap) {
            covered += projection_.rows == nullptr ? drawDepthTile(work, pixels)
                                                   : drawUnevenTile(work, *projection_.rows, pixels);
        } else {
            if (depths.hides(box, reversedNearness(clampedDepth(cluster.maxZ)))) continue;
            noteSetUp(drawn.cluster, drawVisibilityTile(work, pixels, &depths));
        }
        depths.noteDrawn(box);
    }
    return covered;
}

void OcclusionPass::drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, std::uint64_t* words) {
    drawOver<WordDepths>(tile, indices, words);
}

std::uint64_t OcclusionPass::drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, float* depths) {
    return drawOver<MapDepths>(tile, indices, depths);
}

OcclusionCounts OcclusionPass::counts() const {
    OcclusionCounts counts;
    for (std::size_t i = 0; i < snapped_->all().size() * TriangleBits().size(); ++i)
        counts.trianglesSetUp +=
            static_cast<std::uint64_t>(std::popcount(setUpBits_[i].load(std::memory_order_relaxed)));
    for (const Drawn& drawn : drawn_) {
        const std::uint32_t i = drawn.cluster;
        if (!isBounded(i) || stages_[i].load(std::memory_order_relaxed) == Stage::Snapped) continue;
        ++counts.clustersHidden;
        counts.trianglesHidden += input_[i].triangles.size();
    }
    return counts;
}

} // namespace gnomon::raster
