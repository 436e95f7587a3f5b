// A pass that draws from the front to the back and leaves out the clusters that what is drawn hides.
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

/// Sorts `keys` by their upper halves, and leaves those with the same in their order (a radix sort, least digit first);
/// the upper halves are at most the bits of 1.0F. `scratch` is overwritten.
void sortByUpperHalf(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& scratch);

/// Which depths are near: the large ones of a visibility pass, or the small ones of a shadow map.
enum class DepthOrder : std::uint8_t { Reversed, Plain };

/// One pass at a time; keeps its memory from pass to pass. Each tile decides by its own pixels, in an order of its own,
/// what it leaves out, so this depends on nothing but the clusters.
class OcclusionPass {
public:
    /// Orders the clusters of a pass over `viewport`. Those whose boxes have no bounds are snapped into `snapped`, the
    /// others when they are drawn. `input` and `snapped` must outlive the pass.
    void prepare(
        std::span<const Cluster> input,
        std::span<const CellBox> boxes,
        const Projection& projection,
        const PixelBox& viewport,
        DepthOrder order,
        SnappedClusters& snapped);

    /// What is to be binned, nearest first.
    std::span<const BinItem> items() const { return items_; }

    /// Draws the items of a tile, the indices in order, into its empty `words`; from any thread.
    void drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, std::uint64_t* words);

    /// The same into the empty `depths` of a tile of a map; how many pixels the drawn triangles cover.
    std::uint64_t drawTile(const PixelBox& tile, std::span<const std::uint32_t> indices, float* depths);

    /// What was left out, once all tiles are drawn.
    OcclusionCounts counts() const;

private:
    enum class Stage : std::uint8_t { Waiting, InWork, Snapped };

    /// What an item draws.
    struct Drawn {
        std::uint32_t cluster = 0; // in SnappedClusters::all
        std::uint32_t nearest = 0; // nothing of it is nearer
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
    std::vector<BoxBound> bounds_; // of each cluster of the pass
    Buffer<std::atomic<Stage>> stageBuffer_;
    std::atomic<Stage>* stages_ = nullptr; // likewise
    std::vector<std::uint64_t> keys_;      // above how far behind the near plane, below the cluster
    std::vector<std::uint64_t> scratch_;
    std::vector<BinItem> items_;
    std::vector<Drawn> drawn_;                 // of each item
    Buffer<std::atomic<std::uint64_t>> setUp_; // TriangleBits of each of snapped_'s clusters
    std::atomic<std::uint64_t>* setUpBits_ = nullptr;
};

} // namespace gnomon::raster
