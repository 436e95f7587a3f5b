// Rasterising the triangles of one tile into the tile's own memory.
#pragma once

#include "raster/farthest_depths.h"
#include "raster/tile_work.h"

namespace gnomon::raster {

/// Lowers `depths` (kTilePixels, row r of the tile at r * kTileStride) where a triangle is nearer to the light; how
/// many pixels of the tile the triangles cover, each one's counted.
std::uint64_t drawDepthTile(const TileWork& work, float* depths);

/// The same where the clusters' y is that of uneven `rows`, of the pass's viewport.
std::uint64_t drawUnevenTile(const TileWork& work, const RowBands& rows, float* depths);

/// Raises `words` likewise where a triangle is nearer to the eye. With `farthest`, of these words, triangles are passed
/// by of which every pixel between their extremes holds something nearer than all of them before their cluster is
/// drawn. Answers which triangles of the last cluster were set up: given edge functions.
TriangleBits drawVisibilityTile(
    const TileWork& work, std::uint64_t* words, FarthestDepths<WordDepths>* farthest = nullptr);

} // namespace gnomon::raster
