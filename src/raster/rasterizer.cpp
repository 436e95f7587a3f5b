#include "core/check.h"
#include "raster/binning.h"
#include "raster/clip.h"
#include "raster/prefetch.h"
#include "raster/tile_kernel.h"
#include "raster/vertex_kernel.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <vector>

namespace gnomon::raster {
namespace {

/// Triangles that were cut, or lie in one cluster with some that were: three vertices of its own for each.
struct CutCluster {
    static constexpr std::size_t kMostTriangles = kMaxClusterVertices / 3;
    std::array<std::int32_t, kMaxClusterVertices> x{};
    std::array<std::int32_t, kMaxClusterVertices> y{};
    std::array<float, kMaxClusterVertices> z{};
    std::array<std::uint32_t, kMaxClusterVertices> rests{};
    std::array<std::uint32_t, kMostTriangles> ids{};
    std::size_t count = 0; // of triangles
    PixelBox box{kMaxTargetSide, kMaxTargetSide, 0, 0};
};

constexpr std::array<Triangle, CutCluster::kMostTriangles> unsharedTriangles() {
    std::array<Triangle, CutCluster::kMostTriangles> triangles{};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            triangles[i][k] = static_cast<std::uint8_t>(3 * i + k);
    return triangles;
}

constexpr std::array<Triangle, CutCluster::kMostTriangles> kUnsharedTriangles = unsharedTriangles();

/// Grows without keeping or clearing what it held.
template <class T>
class Buffer {
public:
    T* reserve(std::size_t count) {
        if (count > capacity_) {
            memory_ = std::make_unique_for_overwrite<T[]>(count);
            capacity_ = count;
        }
        return memory_.get();
    }

private:
    std::unique_ptr<T[]> memory_;
    std::size_t capacity_ = 0;
};

/// Cut clusters that one thread makes; addresses stay.
struct CutClusters {
    std::deque<CutCluster> clusters;
    std::size_t count = 0;

    CutCluster& next() {
        if (count == clusters.size()) clusters.emplace_back();
        CutCluster& cluster = clusters[count++];
        cluster.count = 0;
        cluster.box = CutCluster{}.box;
        return cluster;
    }
};

void addTriangle(CutCluster& cut, const std::array<SnappedVertex, 3>& corners, std::uint32_t id) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = 3 * cut.count + k;
        cut.x[vertex] = corners[k].x;
        cut.y[vertex] = corners[k].y;
        cut.z[vertex] = corners[k].z;
        cut.rests[vertex] = packedRests(corners[k]);
        cut.box.x0 = std::min(cut.box.x0, (corners[k].x + kSubpixels - 1) >> kSubpixelBits);
        cut.box.y0 = std::min(cut.box.y0, (corners[k].y + kSubpixels - 1) >> kSubpixelBits);
        cut.box.x1 = std::max(cut.box.x1, (corners[k].x >> kSubpixelBits) + 1);
        cut.box.y1 = std::max(cut.box.y1, (corners[k].y >> kSubpixelBits) + 1);
    }
    cut.ids[cut.count++] = id;
}

/// Cuts every triangle of a cluster that needs it and copies the others.
void cutTriangles(const Projection& projection, const Cluster& cluster, CutClusters& cuts) {
    std::array<ClipPosition, kMaxClusterVertices> positions;
    for (std::uint32_t i = 0; i < cluster.vertexCount; ++i)
        positions[i] = clipPosition(
            projection, cluster.positions + std::size_t{i} * (cluster.positionStride / sizeof(std::uint32_t)));
    CutCluster* cut = &cuts.next();
    for (std::uint32_t i = 0; i < cluster.triangles.size(); ++i) {
        const Triangle& triangle = cluster.triangles[i];
        const std::array<ClipPosition, 3> corners = {
            positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]};
        if ((outsideBits(projection, corners[0]) & outsideBits(projection, corners[1]) &
             outsideBits(projection, corners[2])) != 0)
            continue;
        const ClippedPolygon polygon = clipTriangle(projection, corners);
        for (std::size_t k = 2; k < polygon.count; ++k) {
            if (cut->count == CutCluster::kMostTriangles) cut = &cuts.next();
            addTriangle(
                *cut, {polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]}, cluster.firstTriangleId + i);
        }
    }
}

void checkCluster(const Cluster& cluster) {
    GNOMON_CHECK_OP(cluster.vertexCount, <=, kMaxClusterVertices);
    GNOMON_CHECK_OP(cluster.triangles.size(), <=, kMaxClusterTriangles);
    GNOMON_CHECK_OP(cluster.positionStride % sizeof(std::uint32_t), ==, 0U);
}

void checkViewport(const PixelBox& viewport, int width, int height) {
    GNOMON_CHECK_OP(width, <=, kMaxTargetSide);
    GNOMON_CHECK_OP(height, <=, kMaxTargetSide);
    GNOMON_CHECK(viewport.x0 >= 0 && viewport.y0 >= 0);
    GNOMON_CHECK_OP(viewport.x1, <=, width);
    GNOMON_CHECK_OP(viewport.y1, <=, height);
}

/// A quarter of a tile is not split below this: the clusters that straddle would outweigh the rest.
constexpr int kLeastTileSide = 32;

/// How the two kinds of target differ.
struct DepthKind {
    using Pixel = float;
    static constexpr float kEmpty = 1.0F;
    static constexpr int kSide = kTileSide;

    static std::uint64_t draw(const TileWork& work, float* tile) { return drawDepthTile(work, tile); }
};

struct VisibilityKind {
    using Pixel = std::uint64_t;
    static constexpr std::uint64_t kEmpty = 0;
    static constexpr int kSide = kTileSide / 2; // words are twice as large

    static std::uint64_t draw(const TileWork& work, std::uint64_t* tile) {
        drawVisibilityTile(work, tile);
        return 0; // not counted
    }
};

struct TileMemory {
    Buffer<float> depths;
    Buffer<std::uint64_t> words;

    float* pixels(float /*kind*/) { return depths.reserve(kTilePixels); }

    std::uint64_t* pixels(std::uint64_t /*kind*/) { return words.reserve(kTilePixels); }
};

} // namespace

struct Rasterizer::Memory {
    Buffer<std::int32_t> x;
    Buffer<std::int32_t> y;
    Buffer<float> z;
    Buffer<std::uint32_t> rests;
    std::vector<std::size_t> firstVertices;
    std::vector<SnappedCluster> clusters; // one for each of the pass, then those of cut triangles
    std::vector<BinItem> items;
    Bins bins;
    tbb::enumerable_thread_specific<CutClusters> cuts;
    tbb::enumerable_thread_specific<TileMemory> tiles;
    std::atomic<std::uint64_t> fragments = 0; // of the last pass

    void snapClusters(std::span<const Cluster> input, const Projection& projection);
    void addCutClusters();
    void binClusters(const PixelBox& viewport, int side);

    template <class Kind>
    void drawTiles(typename Kind::Pixel* target, int width, const TileVisitor& onTile);

    template <class Kind>
    void draw(
        std::span<const Cluster> input,
        const Projection& projection,
        const PixelBox& viewport,
        typename Kind::Pixel* target,
        int width,
        const TileVisitor& onTile);
};

/// First step: every vertex once.
void Rasterizer::Memory::snapClusters(std::span<const Cluster> input, const Projection& projection) {
    firstVertices.resize(input.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < input.size(); ++i) {
        checkCluster(input[i]);
        firstVertices[i] = total;
        total += paddedVertexCount(input[i].vertexCount);
    }
    const SnappedArrays all = {x.reserve(total), y.reserve(total), z.reserve(total), rests.reserve(total)};
    clusters.assign(input.size(), {});
    for (CutClusters& cut : cuts)
        cut.count = 0;
    constexpr std::size_t kGrain = 64;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, input.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (i + 1 < range.end())
                prefetch(input[i + 1].positions, std::size_t{input[i + 1].vertexCount} * input[i + 1].positionStride);
            if (input[i].vertexCount == 0) continue;
            const std::size_t first = firstVertices[i];
            const SnappedArrays snapped = {all.x + first, all.y + first, all.z + first, all.rests + first};
            const VertexStage stage = snapVertices(projection, input[i], snapped);
            if (stage.place == ClusterPlace::Cut) cutTriangles(projection, input[i], cuts.local());
            if (stage.place == ClusterPlace::Inside)
                clusters[i] = {
                    snapped,
                    stage.isCompact,
                    input[i].triangles,
                    input[i].vertexCount,
                    input[i].firstTriangleId,
                    nullptr,
                    stage.box};
        }
    });
}

void Rasterizer::Memory::addCutClusters() {
    for (CutClusters& made : cuts)
        for (std::size_t i = 0; i < made.count; ++i) {
            CutCluster& cut = made.clusters[i];
            clusters.push_back(
                {{cut.x.data(), cut.y.data(), cut.z.data(), cut.rests.data()},
                 false,
                 std::span(kUnsharedTriangles).first(cut.count),
                 static_cast<std::uint32_t>(3 * cut.count),
                 0,
                 cut.ids.data(),
                 cut.box});
        }
}

void Rasterizer::Memory::binClusters(const PixelBox& viewport, int side) {
    items.clear();
    for (const SnappedCluster& cluster : clusters)
        items.push_back({cluster.box, static_cast<std::uint32_t>(cluster.triangles.size())});
    binItems(items, viewport, side, kLeastTileSide, bins);
}

/// Last step: each tile in a thread's own memory, then once over the target.
template <class Kind>
void Rasterizer::Memory::drawTiles(typename Kind::Pixel* target, int width, const TileVisitor& onTile) {
    std::atomic<std::size_t> next = 0;
    fragments = 0;
    const auto drawRemaining = [&](int /*worker*/) {
        typename Kind::Pixel* pixels = tiles.local().pixels(typename Kind::Pixel{});
        for (std::size_t t = next++; t < bins.tiles.size(); t = next++) {
            const TileBin& tile = bins.tiles[t];
            for (int row = 0; row < tile.box.height(); ++row)
                std::fill_n(
                    pixels + std::size_t{kTileStride} * static_cast<std::size_t>(row), tile.box.width(), Kind::kEmpty);
            fragments +=
                Kind::draw({tile.box, clusters, std::span(bins.indices).subspan(tile.first, tile.count)}, pixels);
            for (int row = 0; row < tile.box.height(); ++row)
                std::copy_n(
                    pixels + std::size_t{kTileStride} * static_cast<std::size_t>(row),
                    tile.box.width(),
                    target + static_cast<std::size_t>(tile.box.y0 + row) * static_cast<std::size_t>(width) +
                        tile.box.x0);
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
    typename Kind::Pixel* target,
    int width,
    const TileVisitor& onTile) {
    snapClusters(input, projection);
    addCutClusters();
    binClusters(viewport, Kind::kSide);
    drawTiles<Kind>(target, width, onTile);
}

Rasterizer::Rasterizer() : memory_(std::make_unique<Memory>()) {}

Rasterizer::~Rasterizer() = default;
Rasterizer::Rasterizer(Rasterizer&&) noexcept = default;
Rasterizer& Rasterizer::operator=(Rasterizer&&) noexcept = default;

std::uint64_t Rasterizer::drawDepth(std::span<const Cluster> clusters, const View& view, const DepthTarget& target) {
    checkViewport(view.viewport, target.width, target.height);
    memory_->draw<DepthKind>(clusters, projection(view, false), view.viewport, target.depths, target.width, {});
    return memory_->fragments;
}

void Rasterizer::drawVisibility(
    std::span<const Cluster> clusters, const View& view, const VisibilityTarget& target, const TileVisitor& onTile) {
    checkViewport(view.viewport, target.width, target.height);
    memory_->draw<VisibilityKind>(clusters, projection(view, true), view.viewport, target.words, target.width, onTile);
}

} // namespace gnomon::raster
