// What section planes leave of clusters: whole ones, none, or pieces of their triangles.
#pragma once

#include "executor/executor.h"
#include "executor/view/drawn_cluster.h"

#include <deque>

namespace gnomon::executor {

/// Cuts the clusters of a pass by the section planes of a frame. Corners that a cut makes are rounded to the grid,
/// alike on both sides of an edge, so that nothing comes apart. What is seen of a piece is shaded as the triangle that
/// it is a piece of: its place on the screen is all that is cut.
class SectionCut {
public:
    SectionCut() = default;

    /// Begins anew with the planes of `frame`.
    void reset(const FrameDrawing& frame);

    bool isCutting() const { return !planes_.empty(); }

    /// Where a box of the grid lies.
    Containment place(const hierarchy::GridBox& box) const;

    /// Appends what is left of a cluster that a plane goes through: as many clusters as its pieces call for, under the
    /// names from `clusters.size()` on. They are there until the next reset.
    void addPieces(const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn);

private:
    /// A point of the grid, from draw space's origin.
    using Cell = glm::i64vec3;

    /// In cells from draw space's origin; what is kept has a distance of at least 0.
    std::vector<Plane> planes_;
    hierarchy::GridPoint origin_;

    struct Pieces {
        std::vector<std::array<std::uint32_t, 3>> positions;
        std::vector<raster::Triangle> triangles;
        std::vector<hierarchy::Triangle> wholes; // of the source cluster, by piece
    };

    Cell cellOf(const hierarchy::GridPoint& point) const;
    std::vector<Cell> kept(std::array<Cell, 3> corners) const;
    static void flush(
        const DrawnCluster& whole,
        const Pieces& pieces,
        std::vector<raster::Cluster>& clusters,
        std::vector<DrawnCluster>& drawn);

    std::deque<Pieces> pieces_;
};

/// The section planes of `frame` in cells from draw space's origin: what is kept has a distance of at least 0 to each.
std::vector<Plane> sectionPlanes(const FrameDrawing& frame);

} // namespace gnomon::executor
