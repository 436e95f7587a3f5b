// A pass that draws clusters from front to back and skips clusters hidden by drawn triangles (occlusion culling).
#pragma once

#include "raster/binning.h"
#include "raster/box_bound.h"
#include "raster/buffer.h"
#include "raster/farthest_depths.h"
#include "raster/snapped_clusters.h"
#include "raster/tile_work.h"

#include <atomic>
#include <vector>

namespace gnomon::raster {

/// Sorts `keys` by their upper halves with a stable radix sort. The upper halves must be at most the bits of 1.0F. The
/// function overwrites `scratch`.
void sortByUpperHalf(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& scratch);

/// The depth order: large depths are near in a visibility pass, small depths are near in a shadow map.
enum class DepthOrder : std::uint8_t { Reversed, Plain };

/// A front-to-back pass. One object draws one pass at a time and reuses its memory. Each tile tests only its own
/// pixels, in its own order. The skipped clusters therefore depend only on the input.
class OcclusionPass {
public:
    /// Sorts the clusters of a pass over `viewport`. Clusters whose boxes have no bounds are snapped into `snapped` at
    /// once; other clusters are snapped when they are drawn. `input` and `snapped` must outlive the pass.
    void prepare(
        std::span<const Cluster> input,
        std::span<const CellBox> boxes,
        const Projection& projection,
        const PixelBox& viewport,
        DepthOrder order,
        SnappedClusters& snapped);

    /// Returns the items for binning, nearest first.
    std::span<const BinItem> items() const { return items_; }

    /// Draws the items with `indices` (in order) into the empty `words` of a tile. Can run on any thread.
    void drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, std::uint64_t* words);

    /// Draws the items with `indices` into the empty `depths` of a shadow map's tile. Returns the number of pixels that
    /// the drawn triangles cover, summed over triangles.
    std::uint64_t drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, float* depths);

    /// Returns the counts of skipped clusters and triangles. Call it after all tiles are drawn.
    OcclusionCounts counts() const;

private:
    enum class Stage : std::uint8_t { Waiting, InWork, Snapped };

    /// The cluster of an item and its nearest possible depth.
    struct Drawn {
        std::uint32_t cluster = 0; // in SnappedClusters::all
        std::uint32_t nearest = 0; // an upper bound of its nearness
    };

    bool isBounded(std::size_t i) const { return i < input_.size() && bounds_[i].isWhole; }

    std::uint32_t nearnessOf(std::size_t i) const;
    template <class Depths>
    std::uint64_t drawOver(
        const PixelBox& tile, std::span<const std::uint32_t> indices, typename Depths::Pixel* pixels);
    void boundClusters(std::span<const CellBox> boxes);
    void orderItems(const PixelBox& viewport);
    void requireSnapped(std::uint32_t cluster);
    void noteSetUp(std::uint32_t cluster, const TriangleBits& bits);

    std::span<const Cluster> input_;
    Projection projection_;
    SnappedClusters* snapped_ = nullptr;
    DepthOrder order_ = DepthOrder::Reversed;
    std::vector<BoxBound> bounds_; // by cluster of the pass
    Buffer<std::atomic<Stage>> stageBuffer_;
    std::atomic<Stage>* stages_ = nullptr; // points to stageBuffer_
    std::vector<std::uint64_t> keys_;      // upper half: distance behind the near plane; lower half: cluster
    std::vector<std::uint64_t> scratch_;
    std::vector<BinItem> items_;
    std::vector<Drawn> drawn_;                 // by item
    Buffer<std::atomic<std::uint64_t>> setUp_; // TriangleBits of each cluster in snapped_
    std::atomic<std::uint64_t>* setUpBits_ = nullptr;
};

} // namespace gnomon::raster
