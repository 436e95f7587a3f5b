// Draws clusters from front to back, and skips clusters that are hidden by drawn triangles (occlusion culling).
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

/// Sorts `keys` by their upper 32 bits with a stable radix sort. The upper 32 bits must be at most the bits of 1.0F.
/// The function overwrites `scratch`.
void sortByUpperHalf(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& scratch);

/// The order of depths. In a visibility pass, large depths are near (Reversed). In a shadow map, small depths are near
/// (Plain).
enum class DepthOrder : std::uint8_t { Reversed, Plain };

/// A front-to-back pass with occlusion culling. An object draws one pass at a time and reuses its memory. Each tile is
/// tested only against its own pixels and draws its clusters in a fixed order. The skipped clusters therefore depend
/// only on the input.
class OcclusionPass {
public:
    /// Sorts the clusters of a pass over `viewport` by distance. If the pixels of a cluster's box have no bounds, the
    /// function snaps its vertices at once and stores them in `snapped`. All other clusters are snapped when they are
    /// drawn. `input` and `snapped` must outlive the pass.
    void prepare(
        std::span<const Cluster> input,
        std::span<const CellBox> boxes,
        const Projection& projection,
        const PixelBox& viewport,
        DepthOrder order,
        SnappedClusters& snapped);

    /// Returns the pixel boxes and costs of the clusters, nearest first, as input for the binning.
    std::span<const BinItem> items() const { return items_; }

    /// Draws the clusters `indices` of `items()`, in this order, into `words`, the empty visibility buffer of a tile.
    /// Can run on any thread.
    void drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, std::uint64_t* words);

    /// Draws the clusters `indices` of `items()`, in this order, into `depths`, an empty tile of a shadow map. Returns
    /// the number of covered pixels, summed over all drawn triangles.
    std::uint64_t drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, float* depths);

    /// Returns the numbers of skipped clusters and triangles. Must be called after all tiles are drawn.
    OcclusionCounts counts() const;

private:
    enum class Stage : std::uint8_t { Waiting, InWork, Snapped };

    /// A cluster of the pass, and the nearest depth that its triangles can have.
    struct Drawn {
        std::uint32_t cluster = 0; // index in SnappedClusters::all
        std::uint32_t nearest = 0; // upper bound of the nearness of the cluster
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
    std::vector<BoxBound> bounds_; // one per cluster of the pass
    Buffer<std::atomic<Stage>> stageBuffer_;
    std::atomic<Stage>* stages_ = nullptr; // points to stageBuffer_
    std::vector<std::uint64_t> keys_;      // sort keys; upper half: distance behind the near plane; lower half: cluster
    std::vector<std::uint64_t> scratch_;
    std::vector<BinItem> items_;
    std::vector<Drawn> drawn_;                 // one per item
    Buffer<std::atomic<std::uint64_t>> setUp_; // TriangleBits of each cluster in snapped_
    std::atomic<std::uint64_t>* setUpBits_ = nullptr;
};

} // namespace gnomon::raster
