// A pass as the software rasteriser takes it: the clusters of a draw list, and the view of the grid.
#pragma once

#include "executor/executor.h"
#include "executor/view/drawn_cluster.h"
#include "raster/raster.h"

namespace gnomon::executor {

/// Which clusters of a list a pass takes.
enum class Cutting : std::uint8_t { Whole, BySections };

/// The clusters of one draw list; keeps its memory from pass to pass.
class SoftwarePass {
public:
    /// Takes the clusters of `list`, whose pages must outlive the pass, or what the frame's sections leave of them.
    void gather(const FrameDrawing& frame, const selection::DrawList& list, Cutting cutting);

    /// Takes more of them, cut by sections.
    void addCut(const FrameDrawing& frame, const selection::ClusterRange& range);

    /// Adds the one cluster of `ground`, likewise.
    void addGround(const hierarchy::Page& ground);

    std::span<const raster::Cluster> clusters() const { return clusters_; }

    bool hasGround() const { return hasGround_; }

    /// The boxes of these, made anew.
    std::span<const raster::CellBox> boxes();

    /// The same clusters in the same order: their place is in the names of their triangles.
    std::span<const DrawnCluster> drawn() const { return drawn_; }

private:
    void addWhole(const DrawnCluster& drawn);

    std::vector<raster::Cluster> clusters_;
    std::vector<DrawnCluster> drawn_;
    std::vector<raster::CellBox> boxes_;
    bool hasGround_ = false;
};

/// A viewport of the target seen through `clipFromDraw`: the shaders' matrix with the grid's step inside.
raster::View rasterView(const DrawSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport);

/// How the casters of a map are seen, with the rows that the view borrows.
struct MapView {
    std::vector<float> rows; // empty: they lie evenly
    raster::View view;

    MapView(const FrameDrawing& frame, const shadow::ShadowMap& map);
};

} // namespace gnomon::executor
