// Exports a model as 3D Tiles 1.1: an octree of tiles, each a .glb file, with a tileset.json.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::exporter {

/// The options of a tileset.
struct TilesetOptions {
    /// The place of the centre of the model's lowest level: latitude and longitude in degrees, and metres above the
    /// WGS84 ellipsoid. Upright -z is north.
    std::optional<glm::dvec3> place;
    Bytes memory{std::uint64_t{2} << 30U};
    std::uint32_t tileTriangles = 40'000; // approximate triangles per tile
    bool hasSkirts = true;
    bool isPacked = true; // by EXT_meshopt_compression
};

/// The size of an exported tileset.
struct ExportedTileset {
    std::uint64_t tiles = 0; // tiles with content
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    std::uint32_t levels = 0;
};

/// Returns a description of one line.
std::string tilesetText(const ExportedTileset& done);

/// Writes a tileset into `folder`: tiles/LEVEL/X_Y_Z.glb, and finally tileset.json. The folder must be empty or
/// missing. After an error or an interruption all tiles are removed.
///
/// Level k is a uniform cut with about four times the triangles of level k - 1. It is clipped at cells of half the
/// side. The children of a tile replace it (REPLACE). Its geometricError is the limit of its cut in metres, or 0 at the
/// finest detail. The depth of skirts is the error of their level, and at least a quarter of the error of the level
/// above. Fields are not exported. Throws Error.
ExportedTileset exportTileset(
    const std::string& model, const TilesetOptions& options, const std::string& folder, Progress& progress);

} // namespace gnomon::exporter
