// A pass as the software rasteriser takes it: the clusters of a draw list, and the view of the grid.
#pragma once

#include "executor/executor.h"
#include "raster/raster.h"

namespace gnomon::executor {

/// A triangle's name in the visibility buffer: the drawn cluster's place above, the triangle's place in it below.
constexpr unsigned kTriangleBits = 8;
static_assert(raster::kMaxClusterTriangles == 1U << kTriangleBits);

/// A cluster of a pass, as shading wants it.
struct DrawnCluster {
    const hierarchy::Vertex* vertices = nullptr;
    const hierarchy::Triangle* triangles = nullptr;
    const hierarchy::Page* page = nullptr;
    std::uint32_t pageId = 0;
    std::uint32_t cluster = 0; // in the page
};

/// The clusters of one draw list; keeps its memory from pass to pass.
class SoftwarePass {
public:
    /// Takes the clusters of `list`, whose pages must outlive the pass.
    void gather(const FrameDrawing& frame, const selection::DrawList& list);

    std::span<const raster::Cluster> clusters() const { return clusters_; }

    /// The boxes of these, made anew.
    std::span<const raster::CellBox> boxes();

    /// The same clusters in the same order: their place is in the names of their triangles.
    std::span<const DrawnCluster> drawn() const { return drawn_; }

private:
    std::vector<raster::Cluster> clusters_;
    std::vector<DrawnCluster> drawn_;
    std::vector<raster::CellBox> boxes_;
};

/// A viewport of the target seen through `clipFromDraw`: the shaders' matrix with the grid's step inside.
raster::View rasterView(const DrawSpace& space, const glm::dmat4& clipFromDraw, const raster::PixelBox& viewport);

} // namespace gnomon::executor
