// The vertex stage of a pass: snaps the vertices of all clusters to subpixels, and clips triangles that cross the
// guard band or a clip plane.
#pragma once

#include "raster/buffer.h"
#include "raster/projection.h"
#include "raster/tile_work.h"

#include <tbb/enumerable_thread_specific.h>

#include <deque>
#include <vector>

namespace gnomon::raster {

/// A cluster of triangles after clipping. The triangles share no vertices.
struct CutCluster {
    static constexpr std::size_t kMaxTriangles = kMaxClusterVertices / 3;
    std::array<std::int32_t, kMaxClusterVertices> x{};
    std::array<std::int32_t, kMaxClusterVertices> y{};
    std::array<float, kMaxClusterVertices> z{};
    std::array<std::uint32_t, kMaxClusterVertices> rests{};
    std::array<std::uint32_t, kMaxTriangles> ids{};
    std::size_t count = 0; // number of triangles
    PixelBox box{kMaxTargetSide, kMaxTargetSide, 0, 0};
};

/// The clusters of one pass with vertices snapped to subpixels. The object reuses its memory from pass to pass.
class SnappedClusters {
public:
    /// Reserves memory for the clusters of a pass. A cluster counts as outside the viewport until `snap` is called for
    /// it.
    void reset(std::span<const Cluster> input);

    /// Snaps the vertices of cluster `i`. `input` must be the same clusters as for `reset`. Can run on any thread, but
    /// only once per cluster. The triangles that clipping creates are stored separately until `addCuts`.
    ClusterPlace snap(std::span<const Cluster> input, std::size_t i, const Projection& projection);

    /// Appends the triangles that clipping created to the clusters of the pass, in undefined order.
    void addCuts();

    /// Returns the clusters of the pass, followed by clusters of clipped triangles. A cluster of the pass is empty if
    /// it is outside the viewport or if its triangles were clipped.
    std::span<const SnappedCluster> all() const { return clusters_; }

private:
    /// The clipped triangles of one thread. New clusters do not move the existing clusters in memory.
    struct Cuts {
        std::deque<CutCluster> clusters;
        std::size_t count = 0;

        CutCluster& next();
    };

    static void cutTriangles(const Projection& projection, const Cluster& cluster, Cuts& cuts);

    Buffer<std::int32_t> x_;
    Buffer<std::int32_t> y_;
    Buffer<float> z_;
    Buffer<std::uint32_t> rests_;
    SnappedArrays arrays_;
    std::vector<std::size_t> firstVertices_;
    std::vector<SnappedCluster> clusters_; // clusters of the pass, followed by clusters of clipped triangles
    tbb::enumerable_thread_specific<Cuts> cuts_;
};

} // namespace gnomon::raster
