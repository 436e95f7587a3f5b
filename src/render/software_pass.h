// The input of the software rasteriser for one pass: the clusters of a draw list, and the view of the grid.
#pragma once

#include "raster/raster.h"
#include "render/backend.h"
#include "render/view/drawn_cluster.h"

namespace gnomon::render {

/// The treatment of section planes in a pass: whole clusters, or clusters cut by the planes.
enum class Cutting : std::uint8_t { Whole, BySections };

/// The clusters of one draw list. Its memory is reused from pass to pass.
class SoftwarePass {
public:
    /// Collects the clusters of `list`, whose pages must outlive the pass. With Cutting::BySections, collects only the
    /// remaining pieces.
    void gather(const DrawInputs& frame, const lod::DrawList& list, Cutting cutting);

    /// Adds the clusters of `range`, cut by sections.
    void addCut(const DrawInputs& frame, const lod::ClusterRange& range);

    /// Adds the single cluster of the page `ground`.
    void addGround(const hierarchy::Page& ground);

    std::span<const raster::Cluster> clusters() const { return clusters_; }

    bool hasGround() const { return hasGround_; }

    /// Computes and returns the boxes of the clusters.
    std::span<const raster::CellBox> boxes();

    /// Returns the same clusters in the same order. The ids of their triangles contain this index.
    std::span<const DrawnCluster> drawn() const { return drawn_; }

private:
    void addWhole(const DrawnCluster& drawn);

    std::vector<raster::Cluster> clusters_;
    std::vector<DrawnCluster> drawn_;
    std::vector<raster::CellBox> boxes_;
    bool hasGround_ = false;
};

/// Returns the view of a viewport of the target through `clipFromDraw`: the matrix of the shaders, with the grid step
/// included.
raster::View rasterView(
    const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport);

/// The view of a map's casters, with the row positions that the view refers to.
struct MapView {
    std::vector<float> rows; // empty if the rows are evenly spaced
    raster::View view;

    MapView(const DrawInputs& frame, const shadow::ShadowMap& map);
};

} // namespace gnomon::render
