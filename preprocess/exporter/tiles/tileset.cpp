#include "preprocess/exporter/tiles/tileset.h"

#include "core/angle.h"
#include "core/box.h"
#include "core/error.h"
#include "core/file.h"
#include "core/heap.h"
#include "hierarchy/model_file.h"
#include "hierarchy/upright_frame.h"
#include "preprocess/exporter/glb_writer.h"
#include "preprocess/exporter/tiles/tile_levels.h"
#include "preprocess/exporter/tiles/tile_mesh.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace gnomon::exporter {

using namespace hierarchy;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

/// The integer coordinates of an octree cell among the cells of its level.
using CellKey = std::array<std::uint32_t, 3>;

struct Tile {
    Box box; // bounds in metres, upright and relative to the anchor; empty if the tile has no triangles
    bool isFinest = false;
};

using TileLevel = std::map<CellKey, Tile>;

CellKey parentOf(const CellKey& key) {
    return {key[0] / 2, key[1] / 2, key[2] / 2};
}

std::string contentOf(std::size_t level, const CellKey& key) {
    return "tiles/" + std::to_string(level) + "/" + std::to_string(key[0]) + "_" + std::to_string(key[1]) + "_" +
           std::to_string(key[2]) + ".glb";
}

/// An octree cell of one level: the clusters that may overlap it, and the tile that is created from them.
struct CellContent {
    CellKey key{};
    std::vector<const TileCluster*> members;
    Tile tile;
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
};

/// Returns the octree cells in Morton order. Neighbouring cells are then close in this order and reuse decoded pages.
/// The comparison first finds the axis whose coordinates differ in the highest bit.
std::vector<CellContent> inSpace(std::map<CellKey, std::vector<const TileCluster*>> cells) {
    std::vector<CellContent> ordered;
    ordered.reserve(cells.size());
    for (auto& cell : cells)
        ordered.push_back({cell.first, std::move(cell.second), {}, 0, 0});
    std::sort(ordered.begin(), ordered.end(), [](const CellContent& a, const CellContent& b) {
        std::size_t axis = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (std::bit_width(a.key[i] ^ b.key[i]) > std::bit_width(a.key[axis] ^ b.key[axis])) axis = i;
        return a.key[axis] < b.key[axis];
    });
    return ordered;
}

/// Returns an upper bound in bytes of the memory for creating one tile. It contains several copies of the tile's mesh
/// and file, with all triangles of its candidate clusters.
std::uint64_t tileBytes(const CellContent& cell) {
    constexpr std::uint64_t kFixed = std::uint64_t{1} << 20U;
    constexpr std::uint64_t kBytesPerTriangle = 144;
    std::uint64_t triangles = 0;
    for (const TileCluster* member : cell.members)
        triangles += member->triangles;
    return kFixed + kBytesPerTriangle * triangles;
}

/// Says how the threads that create tiles divide the free memory.
struct TileRoom {
    int threads = 1;
    Bytes pages; // bytes per thread for decoded pages
};

/// Returns how many threads can create tiles at the same time, and their memory. Tiles use at most half of the free
/// memory, and decoded pages use the rest. Throws Error if the memory is too small for one tile.
TileRoom roomFor(const std::vector<CellContent>& cells, Bytes memory, const std::string& model) {
    constexpr std::uint64_t kPagesInHand = std::uint64_t{8} << 20U; // bytes of the current and the next decoded page
    constexpr std::uint64_t kMinPages = kPagesInHand + (std::uint64_t{4} << 20U);
    std::uint64_t tile = 0;
    for (const CellContent& cell : cells)
        tile = std::max(tile, tileBytes(cell));
    returnFreedMemory();
    requireRoom({tile + kMinPages}, memory, model, "its tiles");
    const std::uint64_t room = memory.count - residentSize().count;
    const auto maxTiles =
        static_cast<std::uint64_t>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const std::uint64_t threads =
        std::clamp<std::uint64_t>(room / 2 / std::max(tile, kMinPages), 1, std::max<std::uint64_t>(maxTiles, 1));
    return {static_cast<int>(threads), {room / threads - tile - kPagesInHand}};
}

class TilesetWriter {
public:
    TilesetWriter(const ModelFile& file, const TilesetOptions& options, const std::string& folder)
        : file_(file), options_(options), folder_(folder), upright_(uprightFrame(file.summary().up.direction)) {
        const Box bounds = uprightBox(upright_, file.summary().bounds);
        const glm::dvec3 middle = (bounds.min + bounds.max) / 2.0;
        anchor_ = upright_.toWorld({middle.x, bounds.min.y, middle.z});
    }

    ExportedTileset write(Progress& progress) {
        requireRoom({surveyBytes(file_)}, options_.memory, file_.path(), "the list of its clusters");
        const std::vector<TileCluster> clusters = clustersOf(file_, progress);
        const std::vector<double> limits = limitsOf(clusters, options_.tileTriangles);
        std::uint64_t extent = 0;
        for (const TileCluster& cluster : clusters)
            extent = std::max<std::uint64_t>({extent, cluster.box.max.x, cluster.box.max.y, cluster.box.max.z});
        side_ = std::bit_ceil(extent + 1);
        progress.stage("tiles", "levels", limits.size());
        for (std::size_t level = 0; level < limits.size() && (side_ >> level) > 1; ++level) {
            const bool isLast = level + 1 == limits.size() || (side_ >> (level + 1)) <= 1;
            const double limit = isLast ? 0 : limits[level];
            errors_.push_back(limit);
            const double above = level == 0 ? limit : errors_[level - 1];
            writeLevel(clusters, level, limit, above, progress);
            progress.advance(1);
        }
        writeDocument();
        done_.levels = static_cast<std::uint32_t>(levels_.size());
        return done_;
    }

private:
    double metres() const { return rowOf(file_.summary().unit).metres; }

    /// Returns all octree cells that clusters of the cut overlap. Cells below a tile of the finest detail are not
    /// included.
    std::map<CellKey, std::vector<const TileCluster*>> cellsOf(
        const std::vector<TileCluster>& clusters, std::size_t level, double limit) const {
        std::map<CellKey, std::vector<const TileCluster*>> cells;
        const auto shift = static_cast<unsigned>(std::countr_zero(side_ >> level));
        for (const TileCluster& cluster : clusters) {
            if (!cluster.isInCut(limit)) continue;
            const GridBox& box = cluster.box;
            for (std::uint32_t x = box.min.x >> shift; x <= box.max.x >> shift; ++x)
                for (std::uint32_t y = box.min.y >> shift; y <= box.max.y >> shift; ++y)
                    for (std::uint32_t z = box.min.z >> shift; z <= box.max.z >> shift; ++z)
                        if (isBelowCoarser({x, y, z}, level)) cells[{x, y, z}].push_back(&cluster);
        }
        return cells;
    }

    /// Returns true if no tile above this octree cell has the finest detail. The cell then needs its own tile.
    bool isBelowCoarser(CellKey key, std::size_t level) const {
        while (level-- > 0) {
            key = parentOf(key);
            const auto found = levels_[level].find(key);
            if (found != levels_[level].end() && found->second.isFinest) return false;
        }
        return true;
    }

    void writeLevel(
        const std::vector<TileCluster>& clusters, std::size_t level, double limit, double above, Progress& progress) {
        // The depth of skirts is at least a quarter of the error limit of the coarser level. A quarter is sufficient,
        // because stored errors are upper bounds, about four times the measured errors. Deeper skirts would be visible
        // on the other side of thin parts.
        const double depth = std::max(limit, above / 4);
        const double skirt = options_.hasSkirts ? depth / file_.summary().grid.step() : 0;
        std::vector<CellContent> cells = inSpace(cellsOf(clusters, level, limit));
        if (!cells.empty()) fs::create_directories(fs::path(folder_ + "/" + contentOf(level, {})).parent_path());
        const TileRoom room = roomFor(cells, options_.memory, file_.path());
        std::vector<PageCache> caches;
        caches.reserve(static_cast<std::size_t>(room.threads));
        for (int i = 0; i < room.threads; ++i)
            caches.emplace_back(file_, room.pages);
        tbb::task_arena arena(room.threads);
        arena.execute([&] {
            tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
                progress.advance(0); // lets the user interrupt the export
                const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
                writeTile(cells[i], level, limit, skirt, caches[thread]);
            });
        });
        TileLevel tiles;
        for (const CellContent& cell : cells) {
            if (cell.triangles == 0) continue;
            tiles[cell.key] = cell.tile;
            ++done_.tiles;
            done_.triangles += cell.triangles;
            done_.bytes += cell.bytes;
        }
        levels_.push_back(std::move(tiles));
    }

    void writeTile(CellContent& content, std::size_t level, double limit, double skirt, PageCache& pages) const {
        const std::vector<const TileCluster*> members = std::move(content.members);
        TileCell cell;
        cell.side = side_ >> level;
        for (std::size_t i = 0; i < 3; ++i)
            cell.low[i] = content.key[i] * cell.side;
        const CutMesh mesh = tileMesh(members, cell, skirt, file_.summary(), pages);
        content.triangles = mesh.triangles.size();
        if (mesh.triangles.empty()) return;
        content.tile.isFinest =
            limit == 0 ||
            std::all_of(members.begin(), members.end(), [](const TileCluster* member) { return member->isFinest(); });
        for (const Vertex& vertex : mesh.vertices)
            content.tile.box.add(metres() * upright_.toUpright(file_.summary().grid.world(vertex.position) - anchor_));
        const std::string path = folder_ + "/" + contentOf(level, content.key);
        NoProgress unwatched;
        ModelSummary summary = file_.summary();
        summary.fields.clear();
        writeGlb(mesh, summary, path, unwatched, GlbTile{anchor_, options_.isPacked});
        content.bytes = fs::file_size(path);
    }

    /// Creates the missing ancestors of each tile, without triangles. For each tile, the function then computes a box
    /// that contains all its descendants.
    void closeTree() {
        for (std::size_t level = levels_.size(); level-- > 1;)
            for (const auto& [key, tile] : levels_[level])
                levels_[level - 1][parentOf(key)]; // creates the tile if it is missing
        held_.resize(levels_.size());
        for (std::size_t level = levels_.size(); level-- > 0;)
            for (const auto& [key, tile] : levels_[level]) {
                held_[level][key].add(tile.box);
                if (level > 0) held_[level - 1][parentOf(key)].add(held_[level][key]);
            }
    }

    /// Returns the bounding volume of a box in the syntax of 3D Tiles. The up axis of a tileset is z, so upright x, y,
    /// z becomes x, -z, y.
    static ordered_json volumeOf(const Box& box) {
        const glm::dvec3 middle = (box.min + box.max) / 2.0;
        const glm::dvec3 half = (box.max - box.min) / 2.0;
        return {{"box", {middle.x, -middle.z, middle.y, half.x, 0, 0, 0, half.z, 0, 0, 0, half.y}}};
    }

    // Returns the JSON of a tile and all its descendants. The recursion is as deep as the octree, at most 31 levels.
    ordered_json nodeOf(std::size_t level, const CellKey& key) const { // NOLINT(misc-no-recursion)
        const Tile& tile = levels_[level].at(key);
        ordered_json node = {
            {"boundingVolume", volumeOf(held_[level].at(key))},
            {"geometricError", tile.isFinest ? 0 : errors_[level] * metres()}};
        if (!tile.box.isEmpty()) node["content"] = {{"uri", contentOf(level, key)}};
        ordered_json children = ordered_json::array();
        for (std::uint32_t i = 0; i < 8 && level + 1 < levels_.size(); ++i) {
            const CellKey child{2 * key[0] + (i & 1U), 2 * key[1] + (i >> 1U & 1U), 2 * key[2] + (i >> 2U)};
            if (levels_[level + 1].count(child) > 0) children.push_back(nodeOf(level + 1, child));
        }
        if (!children.empty()) node["children"] = std::move(children);
        return node;
    }

    /// Returns the matrix from the tileset's coordinates, whose origin is the anchor, to the model's coordinates. If
    /// the options contain a place on the earth, the matrix converts to coordinates of the earth instead.
    ordered_json transform() const {
        std::array<glm::dvec3, 4> columns{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0)};
        if (options_.place) {
            // The directions east, north and up at a place on the earth (WGS84, NIMA TR8350.2).
            constexpr double kA = 6378137;
            constexpr double kE2 = 6.69437999014e-3;
            const double latitude = radiansFromDegrees(options_.place->x);
            const double longitude = radiansFromDegrees(options_.place->y);
            const double sinLat = std::sin(latitude);
            const double cosLat = std::cos(latitude);
            const double n = kA / std::sqrt(1 - kE2 * sinLat * sinLat);
            const glm::dvec3 up(cosLat * std::cos(longitude), cosLat * std::sin(longitude), sinLat);
            const glm::dvec3 east(-std::sin(longitude), std::cos(longitude), 0);
            columns = {east, glm::cross(up, east), up, (n + options_.place->z) * up};
            columns[3].z -= n * kE2 * sinLat;
        } else {
            const glm::dvec3 at = metres() * upright_.toUpright(anchor_);
            columns[3] = {at.x, -at.z, at.y};
        }
        ordered_json values = ordered_json::array();
        for (std::size_t i = 0; i < 4; ++i) {
            for (int k = 0; k < 3; ++k)
                values.push_back(columns[i][k]);
            values.push_back(i == 3 ? 1 : 0);
        }
        return values;
    }

    void writeDocument() {
        closeTree();
        ordered_json root = nodeOf(0, {0, 0, 0});
        root["refine"] = "REPLACE";
        root["transform"] = transform();
        const Box& all = held_[0].at({0, 0, 0});
        const ordered_json document = {
            {"asset", {{"version", "1.1"}, {"generator", "gnomon"}}},
            {"geometricError", glm::length(all.max - all.min)}, // the error if no tile is drawn
            {"root", root}};
        writeTextFile(folder_ + "/tileset.json", document.dump() + "\n");
    }

    const ModelFile& file_;
    const TilesetOptions& options_;
    const std::string& folder_;
    UprightFrame upright_;
    glm::dvec3 anchor_{0};       // origin of the tileset in world space
    std::uint64_t side_ = 1;     // side of the root cell in grid steps, a power of two
    std::vector<double> errors_; // error limit of the cut of each level, in world units
    std::vector<TileLevel> levels_;
    std::vector<std::map<CellKey, Box>> held_; // bounds of each tile with all its descendants, per level
    ExportedTileset done_;
};

} // namespace

std::string tilesetText(const ExportedTileset& done) {
    return std::to_string(done.tiles) + " tiles in " + std::to_string(done.levels) + " levels, " +
           readableCount(done.triangles) + " triangles, " + readableBytes({done.bytes});
}

ExportedTileset exportTileset(
    const std::string& model, const TilesetOptions& options, const std::string& folder, Progress& progress) {
    std::error_code missing;
    if (fs::exists(folder, missing) && !(fs::is_directory(folder, missing) && fs::is_empty(folder, missing)))
        throw Error(folder, "tiles need an empty folder", "an empty or new folder", "other files");
    if (options.place && !(std::abs(options.place->x) <= 90))
        throw Error("place of the model on the earth", "bad latitude", "-90 to 90", std::to_string(options.place->x));
    const ModelFile file(model);
    const bool isNew = !fs::exists(folder, missing);
    try {
        return TilesetWriter(file, options, folder).write(progress);
    } catch (...) {
        // The tiles are useless without tileset.json, and a second attempt requires an empty folder.
        fs::remove_all(folder + "/tiles", missing);
        if (isNew) fs::remove(folder, missing);
        throw;
    }
}

} // namespace gnomon::exporter
