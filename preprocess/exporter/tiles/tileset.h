// Exports a model as a 3D Tiles 1.1 tileset: an octree of tiles. Each tile is a .glb file, and tileset.json lists them.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::exporter {

/// The options for exporting a tileset.
struct TilesetOptions {
    /// The place on the earth for the centre of the bottom face of the model's bounding box: latitude and longitude in
    /// degrees, and metres above the WGS84 ellipsoid. The model's -z direction, after its up axis is rotated to +y, is
    /// north.
    std::optional<glm::dvec3> place;
    Bytes memory{std::uint64_t{2} << 30U};
    std::uint32_t tileTriangles = 40'000; // approximate number of triangles per tile
    bool hasSkirts = true;
    bool isPacked = true; // whether EXT_meshopt_compression compresses the tiles
};

/// The size of a tileset that was exported.
struct ExportedTileset {
    std::uint64_t tiles = 0; // number of tiles with triangles
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    std::uint32_t levels = 0;
};

/// Returns a description of the exported tileset in one line, for the user.
std::string tilesetText(const ExportedTileset& done);

/// Writes a 3D Tiles tileset into `folder`, which must be empty or missing. The function writes the tiles
/// tiles/LEVEL/X_Y_Z.glb, and tileset.json at the end. After an error or an interruption all tiles are removed. Throws
/// Error.
///
/// The tiles of level k are a uniform cut with about four times the triangles of level k - 1. The cut is clipped at
/// cells of half the side of level k - 1. The children of a tile replace it (REPLACE). The geometricError of a tile is
/// the error limit of its cut in metres, or 0 at the finest detail. The depth of its skirts is this limit, and at least
/// a quarter of the limit of the coarser level. Fields are not exported.
ExportedTileset exportTileset(
    const std::string& model, const TilesetOptions& options, const std::string& folder, Progress& progress);

} // namespace gnomon::exporter
