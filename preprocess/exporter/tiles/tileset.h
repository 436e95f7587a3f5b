// A model as 3D Tiles 1.1: an octree of tiles, each a .glb, under a tileset.json.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::exporter {

struct TilesetOptions {
    /// Where the middle of the model's lowest level stands: degrees of latitude and of longitude, metres above the
    /// WGS84 ellipsoid. Upright -z is north.
    std::optional<glm::dvec3> place;
    Bytes memory{std::uint64_t{2} << 30U};
    std::uint32_t tileTriangles = 40'000; // about, of a tile
    bool hasSkirts = true;
    bool isPacked = true; // by EXT_meshopt_compression
};

struct ExportedTileset {
    std::uint64_t tiles = 0; // with a content
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    std::uint32_t levels = 0;
};

/// One line for people.
std::string tilesetText(const ExportedTileset& done);

/// Writes tileset.json, last, and tiles/LEVEL/X_Y_Z.glb into `folder`, which must be empty or not there; nothing stays
/// of tiles that fail or are interrupted. Level k is a
/// uniform cut of four times the triangles of level k - 1, cut off at the sides of cells of half the length; a tile is
/// replaced by those below it (REPLACE), and its geometricError is the limit of its cut in metres, 0 where it is the
/// finest detail. Skirts
/// are as deep as the error of their level, and a quarter of that above at least. Fields are left out. Throws Error.
ExportedTileset exportTileset(
    const std::string& model, const TilesetOptions& options, const std::string& folder, Progress& progress);

} // namespace gnomon::exporter
