// The mesh of one tile: what its cell holds of a cut, and skirts along the cell's sides.
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

/// Decoded pages, those used last, in bounded memory.
class PageCache {
public:
    /// Holds at most `limit` of decoded pages, and one more.
    PageCache(const hierarchy::ModelFile& file, Bytes limit) : file_(file), limit_(limit) {}

    /// Valid until the next call.
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
    std::list<Held> held_; // used last first
    std::map<std::uint32_t, std::list<Held>::iterator> places_;
};

/// What `cell` holds of `clusters`, welded. Where `skirt`, in steps of the grid, is above 0, edges on the cell's sides
/// get a strip of that depth against the normal, which hides what a neighbour of another level leaves open; it ends
/// where the grid does.
CutMesh tileMesh(
    std::span<const TileCluster* const> clusters,
    const TileCell& cell,
    double skirt,
    const hierarchy::ModelSummary& summary,
    PageCache& pages);

} // namespace gnomon::exporter
