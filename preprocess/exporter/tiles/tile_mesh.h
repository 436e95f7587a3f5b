// Builds the mesh of one tile of a 3D Tiles tileset: the part of a cut inside an octree cell, with skirts along the
// sides of the cell.
#pragma once

#include "hierarchy/model_file.h"
#include "preprocess/exporter/cut_mesh.h"
#include "preprocess/exporter/tiles/clip.h"
#include "preprocess/exporter/tiles/tile_levels.h"

#include <cstdint>
#include <list>
#include <map>
#include <span>

namespace gnomon::exporter {

/// A cache of decoded pages in bounded memory. It evicts the least recently used page first.
class PageCache {
public:
    /// Creates a cache of decoded pages of `file`, which uses at most `limit` bytes plus one page.
    PageCache(const hierarchy::ModelFile& file, Bytes limit) : file_(file), limit_(limit) {}

    /// Returns the decoded page with the index `number`. The reference is valid until the next call.
    const hierarchy::Page& page(std::uint32_t number);

private:
    struct Held {
        std::uint32_t number = 0;
        std::uint64_t bytes = 0;
        hierarchy::Page page;
    };

    const hierarchy::ModelFile& file_;
    Bytes limit_;
    std::uint64_t bytes_ = 0;
    std::list<Held> held_; // the most recently used page is first
    std::map<std::uint32_t, std::list<Held>::iterator> places_;
};

/// Returns the part of `clusters` inside `cell` as a welded mesh. If `skirt` (in grid steps) is positive, each edge on
/// a side of the cell gets a strip of triangles (skirt) with this width, in the direction opposite to the normal.
/// Skirts hide gaps to neighbouring tiles of another level. They end at the border of the grid.
CutMesh tileMesh(
    std::span<const TileCluster* const> clusters,
    const TileCell& cell,
    double skirt,
    const hierarchy::ModelSummary& summary,
    PageCache& pages);

} // namespace gnomon::exporter
