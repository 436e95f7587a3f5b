// The vertex stage of a pass: snaps all clusters to the target and clips the triangles that need it.
#pragma once

#include "raster/buffer.h"
#include "raster/projection.h"
#include "raster/tile_work.h"

#include <tbb/enumerable_thread_specific.h>

#include <deque>
#include <vector>

namespace gnomon::raster {

/// The triangles of a cluster with clipped triangles. Each triangle has three vertices of its own.
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

/// The snapped clusters of one pass at a time. The object reuses its memory.
class SnappedClusters {
public:
    /// Reserves memory for the clusters of a pass. Each cluster counts as outside until it is snapped.
    void reset(std::span<const Cluster> input);

    /// Snaps cluster `i` of `input`, the clusters given to `reset`. Can run on any thread, at most once per cluster.
    /// Clipped triangles are stored until `addCuts`.
    ClusterPlace snap(std::span<const Cluster> input, std::size_t i, const Projection& projection);

    /// Appends the clipped triangles behind the clusters of the pass, in no particular order.
    void addCuts();

    /// Returns the clusters of the pass, followed by the clipped triangles. Outside clusters and clipped clusters are
    /// empty.
    std::span<const SnappedCluster> all() const { return clusters_; }

private:
    /// Clipped clusters from one thread. Their addresses stay valid.
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
    std::vector<SnappedCluster> clusters_; // one per cluster of the pass, followed by clipped triangles
    tbb::enumerable_thread_specific<Cuts> cuts_;
};

} // namespace gnomon::raster
