#include "core/check.h"
#include "raster/binning.h"
#include "raster/buffer.h"
#include "raster/occlusion_pass.h"
#include "raster/prefetch.h"
#include "raster/snapped_clusters.h"
#include "raster/tile_kernel.h"
#include "raster/uneven/row_bands.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace gnomon::raster {
namespace {

void checkViewport(const PixelBox& viewport, int width, int height) {
    GNOMON_CHECK_OP(width, <=, kMaxTargetSide);
    GNOMON_CHECK_OP(height, <=, kMaxTargetSide);
    GNOMON_CHECK(viewport.x0 >= 0 && viewport.y0 >= 0);
    GNOMON_CHECK_OP(viewport.x1, <=, width);
    GNOMON_CHECK_OP(viewport.y1, <=, height);
}

/// Returns the part of `viewport` whose rows the target contains.
PixelBox heldPart(const PixelBox& viewport, const VisibilityTarget& target) {
    const PixelBox held = intersection(viewport, {0, target.firstRow, viewport.x1, target.firstRow + target.height});
    checkViewport(held, target.width, target.firstRow + target.height);
    return held;
}

/// Min side of a tile in pixels. Smaller tiles would be slow, because most clusters would overlap several tiles.
constexpr int kMinTileSide = 32;

/// The pixel type and the constants of a depth map target. VisibilityKind has the same members for a visibility buffer.
struct DepthKind {
    using Pixel = float;
    static constexpr float kEmpty = 1.0F;
    static constexpr int kSide = kTileSide;

    static std::uint64_t draw(const TileWork& work, float* tile) { return drawDepthTile(work, tile); }
};

struct VisibilityKind {
    using Pixel = std::uint64_t;
    static constexpr std::uint64_t kEmpty = 0;
    static constexpr int kSide = kTileSide / 2; // half of the side, because words are twice as large as floats

    static std::uint64_t draw(const TileWork& work, std::uint64_t* tile) {
        drawVisibilityTile(work, tile);
        return 0; // fragments are not counted
    }
};

/// The memory of a depth map or visibility buffer, and the layout of its rows.
template <class Kind>
struct TargetRows {
    typename Kind::Pixel* pixels = nullptr;
    int width = 0;
    int firstRow = 0;
};

struct TileMemory {
    Buffer<float> depths;
    Buffer<std::uint64_t> words;

    float* pixels(float /*kind*/) { return depths.reserve(kTilePixels); }

    std::uint64_t* pixels(std::uint64_t /*kind*/) { return words.reserve(kTilePixels); }
};

} // namespace

struct Rasterizer::Memory {
    SnappedClusters clusters;
    OcclusionPass occlusion;
    RowBands rows; // rows of the current pass, if it draws a logarithmic map
    std::vector<BinItem> items;
    Bins bins;
    tbb::enumerable_thread_specific<TileMemory> tiles;
    std::atomic<std::uint64_t> fragments = 0; // of the last pass
    BoxFilter isWanted;                       // filter of the current pass; empty: all pixels are wanted

    void snapClusters(std::span<const Cluster> input, const Projection& projection);
    void binClusters(const PixelBox& viewport, int side);

    /// Draws all tiles of a pass. The function `drawTile` draws one tile. It receives the clusters and the empty pixels
    /// of the tile, and returns the number of drawn fragments.
    template <class Kind, class DrawTile>
    void drawTiles(const TargetRows<Kind>& target, const TileVisitor& onTile, const DrawTile& drawTile);

    template <class Kind>
    void draw(
        std::span<const Cluster> input,
        const Projection& projection,
        const PixelBox& viewport,
        const TargetRows<Kind>& target,
        const TileVisitor& onTile);

    Projection depthProjection(const View& view);
    void drawUneven(std::span<const Cluster> input, const View& view, const DepthTarget& target);
};

/// First step of a pass: snaps the vertices of each cluster to subpixels.
void Rasterizer::Memory::snapClusters(std::span<const Cluster> input, const Projection& projection) {
    clusters.reset(input);
    constexpr std::size_t kGrain = 64;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, input.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (i + 1 < range.end())
                prefetch(input[i + 1].positions, std::size_t{input[i + 1].vertexCount} * input[i + 1].positionStride);
            clusters.snap(input, i, projection);
        }
    });
    clusters.addCuts();
}

void Rasterizer::Memory::binClusters(const PixelBox& viewport, int side) {
    items.clear();
    for (const SnappedCluster& cluster : clusters.all())
        items.push_back({cluster.box, static_cast<std::uint32_t>(cluster.triangles.size())});
    binWanted(items, viewport, isWanted, side, kMinTileSide, bins);
}

/// Last step of a pass: draws each tile in thread-local memory, and then copies its pixels to the target.
template <class Kind, class DrawTile>
void Rasterizer::Memory::drawTiles(
    const TargetRows<Kind>& target, const TileVisitor& onTile, const DrawTile& drawTile) {
    std::atomic<std::size_t> next = 0;
    fragments = 0;
    const auto drawRemaining = [&](int /*worker*/) {
        typename Kind::Pixel* pixels = tiles.local().pixels(typename Kind::Pixel{});
        for (std::size_t t = next++; t < bins.tiles.size(); t = next++) {
            const TileBin& tile = bins.tiles[t];
            for (int row = 0; row < tile.box.height(); ++row)
                std::fill_n(
                    pixels + std::size_t{kTileStride} * static_cast<std::size_t>(row), tile.box.width(), Kind::kEmpty);
            fragments += drawTile(tile, pixels);
            for (int row = 0; row < tile.box.height(); ++row)
                std::copy_n(
                    pixels + std::size_t{kTileStride} * static_cast<std::size_t>(row),
                    tile.box.width(),
                    target.pixels +
                        static_cast<std::size_t>(tile.box.y0 + row - target.firstRow) *
                            static_cast<std::size_t>(target.width) +
                        static_cast<std::size_t>(tile.box.x0));
            if (onTile) onTile(tile.box);
        }
    };
    tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), drawRemaining);
}

template <class Kind>
void Rasterizer::Memory::draw(
    std::span<const Cluster> input,
    const Projection& projection,
    const PixelBox& viewport,
    const TargetRows<Kind>& target,
    const TileVisitor& onTile) {
    snapClusters(input, projection);
    binClusters(viewport, Kind::kSide);
    drawTiles<Kind>(target, onTile, [this](const TileBin& tile, typename Kind::Pixel* pixels) {
        return Kind::draw({tile.box, clusters.all(), bins.of(tile)}, pixels);
    });
}

/// Returns the vertex stage parameters of a depth pass. If `view` is a logarithmic map, the function also stores its
/// rows.
Projection Rasterizer::Memory::depthProjection(const View& view) {
    if (view.rowPositions.empty()) return projection(view, false);
    GNOMON_CHECK_OP(view.rowPositions.size(), ==, static_cast<std::size_t>(view.viewport.height()));
    rows.reset(view.rowPositions, view.viewport.y0);
    return projection(view, false, &rows);
}

/// Draws a logarithmic shadow map for `drawDepth`.
void Rasterizer::Memory::drawUneven(std::span<const Cluster> input, const View& view, const DepthTarget& target) {
    const Projection projection = depthProjection(view);
    snapClusters(input, projection);
    binClusters(view.viewport, DepthKind::kSide);
    drawTiles<DepthKind>({target.depths, target.width}, {}, [&](const TileBin& tile, float* depths) {
        return drawUnevenTile({tile.box, clusters.all(), bins.of(tile)}, rows, depths);
    });
}

Rasterizer::Rasterizer() : memory_(std::make_unique<Memory>()) {}

Rasterizer::~Rasterizer() = default;
Rasterizer::Rasterizer(Rasterizer&&) noexcept = default;
Rasterizer& Rasterizer::operator=(Rasterizer&&) noexcept = default;

std::uint64_t Rasterizer::drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target) {
    checkViewport(view.viewport, target.width, target.height);
    memory_->isWanted = target.isWanted;
    if (!view.rowPositions.empty()) {
        memory_->drawUneven(clusters, view, target);
        return memory_->fragments;
    }
    memory_->draw<DepthKind>(clusters, projection(view, false), view.viewport, {target.depths, target.width}, {});
    return memory_->fragments;
}

NearestDepths Rasterizer::drawNearestDepth(
    std::span<const Cluster> clusters, std::span<const CellBox> boxes, const View& view, const DepthTarget& target) {
    checkViewport(view.viewport, target.width, target.height);
    Memory& memory = *memory_;
    memory.occlusion.prepare(
        clusters, boxes, memory.depthProjection(view), view.viewport, DepthOrder::Plain, memory.clusters);
    binWanted(memory.occlusion.items(), view.viewport, target.isWanted, DepthKind::kSide, kMinTileSide, memory.bins);
    memory.drawTiles<DepthKind>({target.depths, target.width}, {}, [&memory](const TileBin& tile, float* depths) {
        return memory.occlusion.drawTile(tile.box, memory.bins.of(tile), depths);
    });
    return {memory.fragments, memory.occlusion.counts()};
}

void Rasterizer::drawVisibility(
    std::span<const Cluster> clusters, const View& view, const VisibilityTarget& target, const TileVisitor& onTile) {
    const PixelBox held = heldPart(view.viewport, target);
    memory_->isWanted = target.isWanted;
    memory_->draw<VisibilityKind>(
        clusters, projection(view, true), held, {target.words, target.width, target.firstRow}, onTile);
}

OcclusionCounts Rasterizer::drawVisible(
    std::span<const Cluster> clusters,
    std::span<const CellBox> boxes,
    const View& view,
    const VisibilityTarget& target) {
    const PixelBox held = heldPart(view.viewport, target);
    Memory& memory = *memory_;
    memory.occlusion.prepare(clusters, boxes, projection(view, true), held, DepthOrder::Reversed, memory.clusters);
    binWanted(memory.occlusion.items(), held, target.isWanted, VisibilityKind::kSide, kMinTileSide, memory.bins);
    memory.drawTiles<VisibilityKind>(
        {target.words, target.width, target.firstRow}, {}, [&memory](const TileBin& tile, std::uint64_t* words) {
            memory.occlusion.drawTile(tile.box, memory.bins.of(tile), words);
            return std::uint64_t{0}; // fragments are not counted
        });
    return memory.occlusion.counts();
}

} // namespace gnomon::raster
