// What section planes leave of clusters: whole ones, none, or some of their triangles and pieces of others.
#pragma once

#include "executor/executor.h"
#include "executor/view/drawn_cluster.h"

#include <span>
#include <unordered_map>

namespace gnomon::executor {

/// Cuts the clusters of a model by section planes, each cluster once as long as the planes stay where they are. Corners
/// that a cut makes are rounded to the grid, alike on both sides of an edge, so that nothing comes apart. What is seen
/// of a piece is shaded as the triangle that it is a piece of: its place on the screen is all that is cut.
class SectionCut {
public:
    /// Forgets what was cut, if other planes than those of `frame` cut it or it is more than 32 MiB.
    void begin(const FrameDrawing& frame);

    /// Where a box of the grid lies.
    Containment place(const hierarchy::GridBox& box) const;

    /// Cuts those of `ranges` that a plane goes through, in parallel.
    void cut(const FrameDrawing& frame, std::span<const selection::ClusterRange> ranges);

    /// Appends what is left of a cluster that a plane goes through: its triangles that no plane touches, on its own
    /// vertices, and as many clusters as the pieces of others call for, under the names from `clusters.size()` on. They
    /// are there until the next `begin`.
    void addPieces(const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn);

private:
    /// What is left of a cluster.
    struct CutCluster {
        std::vector<raster::Triangle> untouched;             // of the cluster's vertices
        std::vector<std::array<std::uint32_t, 3>> positions; // of pieces
        std::vector<raster::Triangle> triangles;             // of these, each part's from its first
        std::vector<hierarchy::Triangle> wholes;             // what they are pieces of

        /// As many pieces as a cluster can hold.
        struct Part {
            std::size_t firstPosition = 0;
            std::size_t firstTriangle = 0;
        };

        std::vector<Part> parts;
    };

    CutCluster* insert(const DrawnCluster& whole);
    static std::size_t bytesOf(const CutCluster& cut);
    void cutCluster(const DrawnCluster& whole, CutCluster& cut) const;
    void cutTriangle(
        const DrawnCluster& whole, const hierarchy::Triangle& triangle, unsigned beyond, CutCluster& cut) const;

    std::vector<Plane> planes_;                          // what is kept has a distance of at least 0; cells of the grid
    std::size_t bytes_ = 0;                              // of what was cut
    std::unordered_map<std::uint64_t, CutCluster> cuts_; // by page and cluster
};

/// The section planes of `frame` in cells from draw space's origin: what is kept has a distance of at least 0 to each.
std::vector<Plane> sectionPlanes(const FrameDrawing& frame);

/// The same in cells of the grid.
std::vector<Plane> sectionPlanesOfGrid(const FrameDrawing& frame);

} // namespace gnomon::executor
