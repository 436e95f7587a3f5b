#include "raster/snapped_clusters.h"

#include "core/check.h"
#include "raster/clip.h"
#include "raster/uneven/row_bands.h"

#include <algorithm>
#include <bit>

namespace gnomon::raster {
namespace {

constexpr std::array<Triangle, CutCluster::kMaxTriangles> unsharedTriangles() {
    std::array<Triangle, CutCluster::kMaxTriangles> triangles{};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            triangles[i][k] = static_cast<std::uint8_t>(3 * i + k);
    return triangles;
}

constexpr std::array<Triangle, CutCluster::kMaxTriangles> kUnsharedTriangles = unsharedTriangles();

/// Returns the first row and the end (exclusive) of the rows that a triangle corner can touch.
std::array<int, 2> rowsOf(const RowBands* rows, const SnappedVertex& corner) {
    if (rows == nullptr) return {(corner.y + kSubpixels - 1) >> kSubpixelBits, (corner.y >> kSubpixelBits) + 1};
    const auto position = std::bit_cast<float>(corner.y);
    return rows->rowsBetween(position, position);
}

void addTriangle(
    CutCluster& cut, const std::array<SnappedVertex, 3>& corners, std::uint32_t id, const Projection& projection) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = 3 * cut.count + k;
        cut.x[vertex] = corners[k].x;
        cut.y[vertex] = corners[k].y;
        cut.z[vertex] = corners[k].z;
        cut.rests[vertex] = packedRests(corners[k]);
        const auto [firstRow, endRow] = rowsOf(projection.rows, corners[k]);
        cut.box.x0 = std::min(cut.box.x0, (corners[k].x + kSubpixels - 1) >> kSubpixelBits);
        cut.box.y0 = std::min(cut.box.y0, firstRow);
        cut.box.x1 = std::max(cut.box.x1, (corners[k].x >> kSubpixelBits) + 1);
        cut.box.y1 = std::max(cut.box.y1, endRow);
    }
    cut.ids[cut.count++] = id;
}

void checkCluster(const Cluster& cluster) {
    GNOMON_CHECK_OP(cluster.vertexCount, <=, kMaxClusterVertices);
    GNOMON_CHECK_OP(cluster.triangles.size(), <=, kMaxClusterTriangles);
    GNOMON_CHECK_OP(cluster.positionStride % sizeof(std::uint32_t), ==, 0U);
}

} // namespace

CutCluster& SnappedClusters::Cuts::next() {
    if (count == clusters.size()) clusters.emplace_back();
    CutCluster& cluster = clusters[count++];
    cluster.count = 0;
    cluster.box = CutCluster{}.box;
    return cluster;
}

/// Clips the triangles of a cluster, and appends the resulting triangles to `cuts`. Triangles that need no clipping are
/// copied.
void SnappedClusters::cutTriangles(const Projection& projection, const Cluster& cluster, Cuts& cuts) {
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
            if (cut->count == CutCluster::kMaxTriangles) cut = &cuts.next();
            addTriangle(
                *cut,
                {polygon.corners[0], polygon.corners[k - 1], polygon.corners[k]},
                cluster.firstTriangleId + i,
                projection);
        }
    }
}

void SnappedClusters::reset(std::span<const Cluster> input) {
    firstVertices_.resize(input.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < input.size(); ++i) {
        checkCluster(input[i]);
        firstVertices_[i] = total;
        total += paddedVertexCount(input[i].vertexCount);
    }
    arrays_ = {x_.reserve(total), y_.reserve(total), z_.reserve(total), rests_.reserve(total)};
    clusters_.assign(input.size(), {});
    for (Cuts& cuts : cuts_)
        cuts.count = 0;
}

ClusterPlace SnappedClusters::snap(std::span<const Cluster> input, std::size_t i, const Projection& projection) {
    if (input[i].vertexCount == 0) return ClusterPlace::Outside;
    const std::size_t first = firstVertices_[i];
    const SnappedArrays snapped = {arrays_.x + first, arrays_.y + first, arrays_.z + first, arrays_.rests + first};
    const VertexStage stage = snapVertices(projection, input[i], snapped);
    if (stage.place == ClusterPlace::Cut) cutTriangles(projection, input[i], cuts_.local());
    if (stage.place == ClusterPlace::Inside)
        clusters_[i] = {
            snapped,
            stage.isCompact,
            input[i].triangles,
            input[i].vertexCount,
            input[i].firstTriangleId,
            nullptr,
            stage.box,
            stage.maxZ};
    return stage.place;
}

void SnappedClusters::addCuts() {
    for (Cuts& made : cuts_)
        for (std::size_t i = 0; i < made.count; ++i) {
            CutCluster& cut = made.clusters[i];
            clusters_.push_back(
                {{cut.x.data(), cut.y.data(), cut.z.data(), cut.rests.data()},
                 false,
                 std::span(kUnsharedTriangles).first(cut.count),
                 static_cast<std::uint32_t>(3 * cut.count),
                 0,
                 cut.ids.data(),
                 cut.box,
                 *std::max_element(cut.z.begin(), cut.z.begin() + 3 * cut.count)});
        }
}

} // namespace gnomon::raster
