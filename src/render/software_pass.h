// The input of the software rasteriser for one pass: the clusters to draw, and the projection.
#pragma once

#include "raster/raster.h"
#include "render/backend.h"
#include "render/view/drawn_cluster.h"

namespace gnomon::render {

/// Tells whether section planes cut the clusters of a pass.
enum class Cutting : std::uint8_t { Whole, BySections };

/// The clusters that the software rasteriser draws in one pass. The object reuses its memory from pass to pass.
class SoftwarePass {
public:
    /// Collects the clusters of `list`, whose pages must outlive the pass. With Cutting::BySections, collects only the
    /// parts of clusters that the section planes do not remove.
    void gather(const DrawInputs& frame, const lod::DrawList& list, Cutting cutting);

    /// Adds the clusters of `range`, without the parts that the section planes remove.
    void addCut(const DrawInputs& frame, const lod::ClusterRange& range);

    /// Adds the ground plane, the single cluster of the page `ground`.
    void addGround(const hierarchy::Page& ground);

    std::span<const raster::Cluster> clusters() const { return clusters_; }

    bool hasGround() const { return hasGround_; }

    /// Computes the bounding boxes of all clusters of the pass and returns them.
    std::span<const raster::CellBox> boxes();

    /// Returns the clusters with their pages, in the order of `clusters`. A triangle id in the visibility buffer
    /// contains the index of its cluster in this list.
    std::span<const DrawnCluster> drawn() const { return drawn_; }

private:
    void addWhole(const DrawnCluster& drawn);

    std::vector<raster::Cluster> clusters_;
    std::vector<DrawnCluster> drawn_;
    std::vector<raster::CellBox> boxes_;
    bool hasGround_ = false;
};

/// Returns the rasteriser's projection for drawing into `viewport` with the matrix `clipFromDraw`. The matrix is the
/// matrix of the shaders, multiplied by the grid step.
raster::View rasterView(
    const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport);

/// The projection for drawing the casters of a shadow map. `view` refers to the row positions in `rows`.
struct MapView {
    std::vector<float> rows; // empty if the rows are evenly spaced
    raster::View view;

    MapView(const DrawInputs& frame, const shadow::ShadowMap& map);
};

} // namespace gnomon::render
