// Clips clusters by section planes. A cluster stays whole, disappears, or is replaced by its remaining triangles and
// pieces of triangles.
#pragma once

#include "render/backend.h"
#include "render/view/drawn_cluster.h"

#include <span>
#include <unordered_map>

namespace gnomon::render {

/// A cache of clusters clipped by section planes. While the planes do not move, each cluster is clipped only once. New
/// corners are rounded to the grid, equally in both triangles of an edge, so no cracks appear. A piece of a triangle is
/// shaded like the whole triangle.
class SectionCut {
public:
    /// Begins a frame. The function clears the cache of clipped clusters if the section planes have moved or if the
    /// cache exceeds 32 MiB.
    void begin(const DrawInputs& frame);

    /// Returns whether a box of grid positions is inside, outside or intersected by the section planes.
    Containment place(const hierarchy::GridBox& box) const;

    /// Clips all clusters of `ranges` that a section plane intersects, in parallel, and stores the results in the
    /// cache.
    void cut(const DrawInputs& frame, std::span<const lod::ClusterRange> ranges);

    /// Appends the remaining parts of the cluster `whole`, which a section plane intersects. First come the triangles
    /// that no plane intersects, with the vertices of the cluster. Then come as many clusters as the cut pieces need.
    /// Triangle ids contain the index in `clusters`, so they start at `clusters.size()`. The appended clusters stay
    /// valid until the next `begin`.
    void addPieces(const DrawnCluster& whole, std::vector<raster::Cluster>& clusters, std::vector<DrawnCluster>& drawn);

private:
    /// The remaining geometry of a cluster after clipping by section planes.
    struct CutCluster {
        // Triangles that no section plane intersects. They use the vertices of the cluster.
        std::vector<raster::Triangle> untouched;
        std::vector<std::array<std::uint32_t, 3>> positions; // corners of the pieces
        // Triangles of the cut pieces. Their vertex indices are relative to the first position of their Part.
        std::vector<raster::Triangle> triangles;
        std::vector<hierarchy::Triangle> wholes; // original triangle of each piece

        /// A range of cut pieces that fit into one cluster of the rasteriser.
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

    // The section planes, in grid cells. Points with a distance of at least 0 remain.
    std::vector<Plane> planes_;
    std::size_t bytes_ = 0;                              // size of the cache in bytes
    std::unordered_map<std::uint64_t, CutCluster> cuts_; // keyed by page and cluster
};

/// Returns the section planes of `frame`, in cells from the origin of camera-relative space. Points with a distance of
/// at least 0 remain.
std::vector<Plane> sectionPlanes(const DrawInputs& frame);

/// Returns the section planes of `frame`, in cells from the origin of the model's grid.
std::vector<Plane> sectionPlanesOfGrid(const DrawInputs& frame);

} // namespace gnomon::render
