// Clipping of clusters by section planes: a cluster stays whole, disappears, or is replaced by triangles and pieces of
// triangles.
#pragma once

#include "render/backend.h"
#include "render/view/drawn_cluster.h"

#include <span>
#include <unordered_map>

namespace gnomon::render {

/// A cache of clusters clipped by section planes. Each cluster is clipped once, as long as the planes do not move. New
/// corners are rounded to the grid equally on both sides of an edge, so no cracks appear. A piece has the shading of
/// its original triangle; only its position on the screen is clipped.
class SectionCut {
public:
    /// Clears the cache if the planes of `frame` have changed or the cache exceeds 32 MiB.
    void begin(const DrawInputs& frame);

    /// Classifies a box of the grid against the planes.
    Containment place(const hierarchy::GridBox& box) const;

    /// Clips the clusters of `ranges` that intersect a plane, in parallel.
    void cut(const DrawInputs& frame, std::span<const lod::ClusterRange> ranges);

    /// Appends the remaining parts of a cluster that intersects a plane. First come the triangles that no plane
    /// intersects, with the vertices of the cluster. Then come as many clusters as the pieces need. Their ids start at
    /// `clusters.size()`. They stay valid until the next `begin`.
    void addPieces(const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn);

private:
    /// The remaining parts of a cluster.
    struct CutCluster {
        std::vector<raster::Triangle> untouched;             // refer to the cluster's vertices
        std::vector<std::array<std::uint32_t, 3>> positions; // corners of the pieces
        // Triangles of the pieces. Their indices are relative to the first corner of their part.
        std::vector<raster::Triangle> triangles;
        std::vector<hierarchy::Triangle> wholes; // original triangle per piece

        /// A part with at most as many pieces as a cluster may have.
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
        const DrawnCluster& whole, const hierarchy::Triangle& triangle, unsigned outside, CutCluster& cut) const;

    // Planes in cells of the grid. The remaining side has a distance of at least 0.
    std::vector<Plane> planes_;
    std::size_t bytes_ = 0;                              // size of the cache
    std::unordered_map<std::uint64_t, CutCluster> cuts_; // per page and cluster
};

/// Returns the section planes of `frame` in cells from the origin of camera-relative space. The kept side of each plane
/// has a distance of at least 0.
std::vector<Plane> sectionPlanes(const DrawInputs& frame);

/// Returns the section planes of `frame` in cells of the grid.
std::vector<Plane> sectionPlanesOfGrid(const DrawInputs& frame);

} // namespace gnomon::render
