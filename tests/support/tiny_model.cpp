#include "tests/support/tiny_model.h"

#include "core/random.h"
#include "hierarchy/codec/cluster_order.h"
#include "hierarchy/model_writer.h"
#include "hierarchy/octahedral.h"
#include "hierarchy/validation.h"
#include "tests/support/height_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon::tests {

using namespace hierarchy;

namespace {

constexpr int kTinyStepExponent = -8;
constexpr std::uint32_t kCellSteps = 256; // one world unit

/// A cluster of the build, before it is laid into a page.
struct Piece {
    std::vector<HeightTriangle> triangles;
    std::uint32_t refinement = kNone; // a group of the level below
};

struct PieceGroup {
    std::vector<std::uint32_t> pieces;
    Sphere bounds;
    double error = std::numeric_limits<double>::infinity();
    GroupRef place;
};

struct Level {
    std::vector<Piece> pieces;
    std::vector<PieceGroup> groups;
};

struct Ground {
    std::vector<GridPoint> points;
    std::vector<glm::dvec3> positions; // local
    std::vector<Vertex> vertices;
    std::set<std::uint32_t> border;
    std::vector<HeightTriangle> triangles;
};

/// Bilinear value noise in [0, 1) with cells of 2^k grid cells.
double noise(std::uint64_t seed, std::uint32_t x, std::uint32_t z, unsigned k) {
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
        const std::uint64_t cell = static_cast<std::uint64_t>(i) << 32U | j;
        return static_cast<double>(mix64(cell ^ mix64(seed + k)) >> 11U) * 0x1.0p-53;
    };
    const std::uint32_t i = x >> k;
    const std::uint32_t j = z >> k;
    const double fx = static_cast<double>(x - (i << k)) / static_cast<double>(1U << k);
    const double fz = static_cast<double>(z - (j << k)) / static_cast<double>(1U << k);
    const double low = corner(i, j) * (1 - fx) + corner(i + 1, j) * fx;
    const double high = corner(i, j + 1) * (1 - fx) + corner(i + 1, j + 1) * fx;
    return low * (1 - fz) + high * fz;
}

double heightOf(const TinyModelOptions& options, std::uint32_t x, std::uint32_t z) {
    double height = 0;
    for (unsigned k = 0; k <= options.gridExponent; ++k)
        height += noise(options.seed, x, z, k) * std::ldexp(options.height, static_cast<int>(k)) /
                  std::ldexp(2.0, static_cast<int>(options.gridExponent));
    return height;
}

/// Vertices from the points and triangles of `ground`.
void makeVertices(const TinyModelOptions& options, Ground& ground) {
    const auto& p = ground.positions;
    std::vector<glm::dvec3> normals(p.size(), glm::dvec3(0));
    for (const auto& [a, b, c] : ground.triangles)
        for (const std::uint32_t v : {a, b, c})
            normals[v] += glm::cross(p[b] - p[a], p[c] - p[a]);
    ground.vertices.resize(p.size());
    for (std::uint32_t v = 0; v < p.size(); ++v) {
        Vertex& vertex = ground.vertices[v];
        vertex.position = ground.points[v];
        if (options.normals) vertex.normal = packNormal(normals[v]);
        if (options.colors) vertex.color = static_cast<std::uint32_t>(mix64(v / 7)) | 0xFF000000U;
    }
}

Ground makeGround(const TinyModelOptions& options) {
    Ground ground;
    const std::uint32_t cells = 1U << options.gridExponent;
    const auto id = [cells](std::uint32_t x, std::uint32_t z) { return x * (cells + 1) + z; };
    for (std::uint32_t x = 0; x <= cells; ++x)
        for (std::uint32_t z = 0; z <= cells; ++z) {
            const auto y = static_cast<std::uint32_t>(std::lround(heightOf(options, x, z) * kCellSteps));
            const GridPoint p{x * kCellSteps, y, z * kCellSteps};
            ground.points.push_back(p);
            ground.positions.push_back(Grid{glm::dvec3(0), kTinyStepExponent}.local(p));
            if (x == 0 || z == 0 || x == cells || z == cells) ground.border.insert(id(x, z));
        }
    for (std::uint32_t x = 0; x < cells; ++x)
        for (std::uint32_t z = 0; z < cells; ++z) {
            ground.triangles.push_back({id(x, z), id(x, z + 1), id(x + 1, z)});
            ground.triangles.push_back({id(x + 1, z), id(x, z + 1), id(x + 1, z + 1)});
        }
    makeVertices(options, ground);
    return ground;
}

/// Splits `items` by the coordinate of their places in turn (x, then z) until each part has at most `limit`; the cut
/// lies at `share` of the items, so that borders of one level are not those of the next.
template <class Item, class Place>
void split(
    std::span<Item> items, std::size_t limit, double share, const Place& place, std::vector<std::vector<Item>>& parts) {
    if (items.size() <= limit) {
        parts.emplace_back(items.begin(), items.end());
        return;
    }
    Box box;
    for (const Item& item : items)
        box.add(place(item));
    const bool alongX = box.extent().x >= box.extent().z;
    std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
        return alongX ? place(a).x < place(b).x : place(a).z < place(b).z;
    });
    const auto cut = std::clamp<std::size_t>(
        static_cast<std::size_t>(share * static_cast<double>(items.size())), 1, items.size() - 1);
    split(items.first(cut), limit, share, place, parts);
    split(items.subspan(cut), limit, share, place, parts);
}

glm::dvec3 centre(const Ground& ground, std::span<const HeightTriangle> triangles) {
    glm::dvec3 sum(0);
    for (const HeightTriangle& t : triangles)
        sum += ground.positions[t[0]] + ground.positions[t[1]] + ground.positions[t[2]];
    return sum / (3.0 * static_cast<double>(triangles.size()));
}

std::vector<Piece> cutIntoPieces(
    const Ground& ground, std::vector<HeightTriangle> triangles, std::uint32_t limit, std::uint32_t refinement) {
    std::vector<std::vector<HeightTriangle>> parts;
    split<HeightTriangle>(
        triangles, limit, 0.5, [&ground](const HeightTriangle& t) { return centre(ground, std::span(&t, 1)); }, parts);
    std::vector<Piece> pieces;
    pieces.reserve(parts.size());
    for (auto& part : parts)
        pieces.push_back({std::move(part), refinement});
    return pieces;
}

std::vector<HeightTriangle> trianglesOf(const Level& level, const PieceGroup& group) {
    std::vector<HeightTriangle> triangles;
    for (const std::uint32_t piece : group.pieces)
        triangles.insert(triangles.end(), level.pieces[piece].triangles.begin(), level.pieces[piece].triangles.end());
    return triangles;
}

void groupPieces(const Ground& ground, Level& level, const TinyModelOptions& options, double share) {
    std::vector<std::uint32_t> pieces(level.pieces.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        pieces[i] = i;
    std::vector<std::vector<std::uint32_t>> parts;
    split<std::uint32_t>(
        pieces,
        options.groupClusters,
        share,
        [&](std::uint32_t piece) { return centre(ground, level.pieces[piece].triangles); },
        parts);
    for (auto& part : parts)
        level.groups.push_back({std::move(part), {}, std::numeric_limits<double>::infinity(), {}});
}

/// The sphere of a group: around its vertices and the spheres of all that its clusters refine to.
void boundGroup(const Ground& ground, const Level& level, const Level* finer, PieceGroup& group) {
    std::vector<Sphere> parts;
    for (const std::uint32_t piece : group.pieces) {
        for (const HeightTriangle& t : level.pieces[piece].triangles)
            for (const std::uint32_t v : t)
                parts.push_back({ground.positions[v], 0});
        if (finer != nullptr) parts.push_back(finer->groups[level.pieces[piece].refinement].bounds);
    }
    group.bounds = enclosingSphere(parts);
    // The box's corners stick out of the vertices' sphere.
    Box box;
    for (const HeightTriangle& t : trianglesOf(level, group))
        for (const std::uint32_t v : t)
            box.add(ground.positions[v]);
    const glm::dvec3 furthest =
        glm::max(glm::abs(box.min - group.bounds.center), glm::abs(box.max - group.bounds.center));
    group.bounds.radius = std::max(group.bounds.radius, glm::length(furthest));
}

/// Vertices that more than one group uses, and the model's own border.
std::set<std::uint32_t> lockedVertices(const Ground& ground, const Level& level) {
    std::map<std::uint32_t, std::size_t> owner;
    std::set<std::uint32_t> locked = ground.border;
    for (std::size_t g = 0; g < level.groups.size(); ++g)
        for (const HeightTriangle& t : trianglesOf(level, level.groups[g]))
            for (const std::uint32_t v : t)
                if (owner.emplace(v, g).first->second != g) locked.insert(v);
    return locked;
}

/// Simplifies every group of `level`, sets its error, and returns the pieces of the next.
Level coarser(const Ground& ground, Level& level, const Level* finer, const TinyModelOptions& options) {
    Level next;
    const std::set<std::uint32_t> locked = lockedVertices(ground, level);
    for (std::uint32_t g = 0; g < level.groups.size(); ++g) {
        PieceGroup& group = level.groups[g];
        const std::vector<HeightTriangle> triangles = trianglesOf(level, group);
        std::vector<HeightTriangle> coarse = decimated(
            triangles,
            ground.positions,
            [&locked](std::uint32_t v) { return locked.count(v) != 0; },
            triangles.size() / 2);
        double before = Grid{glm::dvec3(0), kTinyStepExponent}.snapError();
        if (finer != nullptr)
            for (const std::uint32_t piece : group.pieces)
                before = std::max(before, finer->groups[level.pieces[piece].refinement].error);
        group.error = before + verticalDeviation(triangles, coarse, ground.positions);
        for (Piece& piece : cutIntoPieces(ground, std::move(coarse), options.clusterTriangles, g))
            next.pieces.push_back(std::move(piece));
    }
    return next;
}

std::vector<Level> makeLevels(const Ground& ground, const TinyModelOptions& options) {
    std::vector<Level> levels(1);
    levels[0].pieces = cutIntoPieces(ground, ground.triangles, options.clusterTriangles, kNone);
    constexpr std::size_t kMaxLevels = 24;
    while (true) {
        const double share = levels.size() % 2 == 1 ? 0.5 : 0.38;
        const Level* finer = levels.size() > 1 ? &levels[levels.size() - 2] : nullptr;
        Level& level = levels.back();
        groupPieces(ground, level, options, share);
        for (PieceGroup& group : level.groups)
            boundGroup(ground, level, finer, group);
        if (level.groups.size() == 1 || levels.size() == kMaxLevels) return levels;
        Level next = coarser(ground, level, finer, options);
        levels.push_back(std::move(next));
    }
}

/// Gives every group its page, coarsest level first.
void placeGroups(std::vector<Level>& levels, std::uint32_t pageGroups) {
    std::uint32_t page = 0;
    for (std::size_t level = levels.size(); level-- > 0;) {
        std::vector<PieceGroup>& groups = levels[level].groups;
        for (std::uint32_t g = 0; g < groups.size(); ++g)
            groups[g].place = {page + g / pageGroups, g % pageGroups};
        page += (static_cast<std::uint32_t>(groups.size()) + pageGroups - 1) / pageGroups;
    }
}

Cluster layPiece(const Ground& ground, const Piece& piece, Page& page) {
    Cluster cluster;
    cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
    cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
    cluster.triangleCount = static_cast<std::uint32_t>(piece.triangles.size());
    std::map<std::uint32_t, std::uint8_t> local;
    for (const HeightTriangle& t : piece.triangles) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [it, isNew] = local.emplace(t[k], static_cast<std::uint8_t>(local.size()));
            if (isNew) {
                page.vertices.push_back(ground.vertices[t[k]]);
                cluster.box.add(ground.points[t[k]]);
            }
            triangle[k] = it->second;
        }
        page.triangles.push_back(triangle);
    }
    cluster.vertexCount = static_cast<std::uint32_t>(local.size());
    return cluster;
}

/// Lays one group into `page`; `finer` is the level that its clusters refine to, if there is one.
void layGroup(const Ground& ground, const Level& level, const Level* finer, const PieceGroup& group, Page& page) {
    Group laid;
    laid.firstCluster = static_cast<std::uint32_t>(page.clusters.size());
    laid.clusterCount = static_cast<std::uint32_t>(group.pieces.size());
    laid.bounds = group.bounds;
    laid.error = group.error;
    for (const std::uint32_t index : group.pieces) {
        const Piece& piece = level.pieces[index];
        Cluster cluster = layPiece(ground, piece, page);
        laid.box.add(cluster.box);
        if (finer != nullptr) {
            const PieceGroup& refined = finer->groups[piece.refinement];
            const auto it = std::ranges::find(page.refinements, refined.place, &Refinement::group);
            cluster.refinement = static_cast<std::uint32_t>(it - page.refinements.begin());
            if (it == page.refinements.end())
                page.refinements.push_back({refined.place, refined.bounds, refined.error});
        }
        page.clusters.push_back(cluster);
    }
    page.groups.push_back(laid);
}

ModelSummary summarize(const Ground& ground, const std::vector<Level>& levels, const TinyModelOptions& options) {
    ModelSummary summary;
    summary.grid = {options.origin, kTinyStepExponent};
    for (const glm::dvec3& p : ground.positions)
        summary.bounds.add(options.origin + p);
    summary.sourceTriangles = ground.triangles.size();
    summary.sourceVertices = ground.points.size();
    summary.hasNormals = options.normals;
    summary.hasColors = options.colors;
    summary.options["made_by"] = "tests";
    for (std::size_t i = 0; i < levels.size(); ++i) {
        LevelInfo info;
        info.clusters = levels[i].pieces.size();
        info.groups = levels[i].groups.size();
        info.maxError = i == 0 ? summary.grid.snapError() : 0;
        for (const Piece& piece : levels[i].pieces) {
            info.triangles += piece.triangles.size();
            if (i > 0) info.maxError = std::max(info.maxError, levels[i - 1].groups[piece.refinement].error);
        }
        summary.levels.push_back(info);
    }
    summary.coarsestTriangles = summary.levels.back().triangles;
    return summary;
}

/// Gives all groups and their copies an error of attributes: it grows as the error does, and faster.
void giveAttributeErrors(TinyModel& model, double from) {
    const auto give = [from](auto& each) {
        each.attributeError = std::isfinite(each.error) ? std::max(0.0, 2 * each.error - from) : 0;
    };
    for (Page& page : model.pages) {
        std::ranges::for_each(page.groups, give);
        std::ranges::for_each(page.refinements, give);
        LevelInfo& level = model.summary.levels[page.level];
        for (const Refinement& refinement : page.refinements)
            level.maxAttributeError = std::max(level.maxAttributeError, refinement.attributeError);
    }
}

} // namespace

TinyModel makeTinyModel(const TinyModelOptions& options) {
    const Ground ground = makeGround(options);
    std::vector<Level> levels = makeLevels(ground, options);
    for (PieceGroup& group : levels.back().groups)
        group.error = std::numeric_limits<double>::infinity();
    placeGroups(levels, options.pageGroups);
    TinyModel model;
    model.summary = summarize(ground, levels, options);
    for (std::size_t i = levels.size(); i-- > 0;)
        for (std::size_t g = 0; g < levels[i].groups.size(); ++g) {
            if (g % options.pageGroups == 0) model.pages.emplace_back().level = static_cast<std::uint32_t>(i);
            layGroup(ground, levels[i], i == 0 ? nullptr : &levels[i - 1], levels[i].groups[g], model.pages.back());
        }
    if (options.attributeErrorFrom >= 0) giveAttributeErrors(model, options.attributeErrorFrom);
    for (Page& page : model.pages)
        orderForCoding(page);
    return model;
}

std::string writeModel(const TinyModel& model, const std::string& path) {
    ModelWriter writer(path);
    for (const Page& page : model.pages)
        writer.append(encodePage(page));
    return writer.finish(model.summary);
}

} // namespace gnomon::tests
