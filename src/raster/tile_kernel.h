// Rasterisation of the triangles of one tile into the memory of the tile.
#pragma once

#include "raster/farthest_depths.h"
#include "raster/tile_work.h"

namespace gnomon::raster {

/// Draws the triangles of `work` into the depth map tile `depths` and keeps the smaller depth per pixel. `depths` has
/// kTilePixels elements; row r begins at r * kTileStride. Returns the number of covered pixels, summed over triangles.
std::uint64_t drawDepthTile(const TileWork& work, float* depths);

/// Draws the triangles of `work` into the tile `depths` of a logarithmic map, whose row positions are `rows`. Keeps the
/// smaller depth per pixel. Returns the number of covered pixels, summed over triangles.
std::uint64_t drawUnevenTile(const TileWork& work, const RowBands& rows, float* depths);

/// Draws the triangles of `work` into the visibility tile `words` and keeps the larger word per pixel. With `farthest`,
/// which belongs to `words`, it skips a triangle if all pixels between its extremes are nearer than the triangle before
/// its cluster is drawn. Returns the triangles of the last cluster that passed setup.
TriangleBits drawVisibilityTile(
    const TileWork& work, std::uint64_t* words, FarthestDepths<WordDepths>* farthest = nullptr);

} // namespace gnomon::raster
