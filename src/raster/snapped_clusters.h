// The vertex stage of a pass: its clusters snapped to the plane of the target, those cut that must be.
#pragma once

#include "raster/buffer.h"
#include "raster/projection.h"
#include "raster/tile_work.h"

#include <tbb/enumerable_thread_specific.h>

#include <deque>
#include <vector>

namespace gnomon::raster {

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

/// The clusters of one pass at a time; keeps its memory from pass to pass.
class SnappedClusters {
public:
    /// Makes room for the clusters of a pass; none of them is snapped yet, and each counts as outside until it is.
    void reset(std::span<const Cluster> input);

    /// Snaps cluster `i` of `input`, which `reset` was told of; from any thread, each at most once. What is to be cut
    /// is kept for `addCuts`.
    ClusterPlace snap(std::span<const Cluster> input, std::size_t i, const Projection& projection);

    /// Adds what was cut, behind the clusters of the pass, in no particular order.
    void addCuts();

    /// As the pass has them, those outside and those cut empty; then what was cut.
    std::span<const SnappedCluster> all() const { return clusters_; }

private:
    /// Cut clusters that one thread makes; addresses stay.
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
    std::vector<SnappedCluster> clusters_; // one for each of the pass, then those of cut triangles
    tbb::enumerable_thread_specific<Cuts> cuts_;
};

} // namespace gnomon::raster
