// Draws the triangles that overlap one tile into the memory of the tile.
#pragma once

#include "raster/farthest_depths.h"
#include "raster/tile_work.h"

namespace gnomon::raster {

/// Draws the triangles of `work` into `depths`, a tile of a depth map. Each pixel receives the smallest depth. `depths`
/// has kTilePixels elements, and row r begins at r * kTileStride. Returns the number of covered pixels, summed over
/// triangles.
std::uint64_t drawDepthTile(const TileWork& work, float* depths);

/// Draws the triangles of `work` into `depths`, a tile of a logarithmic shadow map with the row positions `rows`. Each
/// pixel receives the smallest depth. Returns the number of covered pixels, summed over triangles.
std::uint64_t drawUnevenTile(const TileWork& work, const RowBands& rows, float* depths);

/// Draws the triangles of `work` into `words`, a tile of a visibility buffer. Each pixel receives the largest word. If
/// `farthest` is not null, it contains the farthest depths of `words`, and hidden triangles are skipped. A triangle is
/// hidden if all its pixels were nearer before its cluster was drawn. Returns the triangles of the last cluster that
/// passed triangle setup.
TriangleBits drawVisibilityTile(
    const TileWork& work, std::uint64_t* words, FarthestDepths<WordDepths>* farthest = nullptr);

} // namespace gnomon::raster
