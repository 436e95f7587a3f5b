#include "preprocess/build/weld.h"

#include "hierarchy/octahedral.h"
#include "preprocess/build/index_table.h"
#include "preprocess/build/normals.h"

#include <algorithm>
#include <cmath>

namespace gnomon::preprocess {

namespace {

constexpr std::uint32_t kEmpty = hierarchy::kNone;

/// Edge lengths by powers of two: enough for a median and a low quantile, and free of order.
class EdgeHistogram {
public:
    explicit EdgeHistogram(const SourceMesh& source) {
        for (const Triangle& t : source.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                add(glm::length(source.positions[t[i]] - source.positions[t[(i + 1) % 3]]));
    }

    /// A power of two that is at most the length of all but the shortest `fraction` of the edges, or 0 without edges.
    double quantile(double fraction) const {
        const double rank = static_cast<double>(total_) * fraction;
        std::uint64_t below = 0;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            below += counts_[i];
            if (counts_[i] > 0 && static_cast<double>(below) > rank)
                return std::ldexp(1.0, static_cast<int>(i) - kBias - 1);
        }
        return 0;
    }

private:
    void add(double length) {
        if (!(length > 0)) return;
        int exponent = 0;
        std::frexp(length, &exponent);
        ++counts_[static_cast<std::size_t>(std::clamp(exponent + kBias, 0, 2 * kBias))];
        ++total_;
    }

    static constexpr int kBias = 1200;
    std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(2 * kBias + 1);
    std::uint64_t total_ = 0;
};

/// The largest exponent e with 2^e <= value.
int floorExponent(double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent - 1;
}

std::vector<GridPoint> snap(const std::vector<glm::dvec3>& positions, const Grid& grid) {
    const double scale = 1 / grid.step();
    std::vector<GridPoint> points(positions.size());
    const auto coordinate = [](double value) {
        return static_cast<std::uint32_t>(
            std::clamp(std::floor(value + 0.5), 0.0, static_cast<double>(hierarchy::kMaxGridCoordinate)));
    };
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 p = (positions[i] - grid.origin) * scale;
        points[i] = {coordinate(p.x), coordinate(p.y), coordinate(p.z)};
    }
    return points;
}

/// Welded positions: the id of each source vertex and the point of each id.
struct WeldedPositions {
    std::vector<std::uint32_t> idOf;
    std::vector<GridPoint> points;
};

WeldedPositions weldPositions(const std::vector<GridPoint>& points) {
    WeldedPositions welded;
    welded.idOf.resize(points.size());
    IndexTable table(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const GridPoint& p = points[i];
        const auto next = static_cast<std::uint32_t>(welded.points.size());
        const std::uint32_t id = table.findOrInsert(
            hashOf(p.x, p.y, p.z), next, [&](std::uint32_t other) { return welded.points[other] == p; });
        if (id == next) welded.points.push_back(p);
        welded.idOf[i] = id;
    }
    return welded;
}

bool samePosition(const SourceMesh& source, std::uint32_t a, std::uint32_t b) {
    return a == b || source.positions[a] == source.positions[b];
}

bool isDegenerate(const SourceMesh& source, const Triangle& t) {
    return samePosition(source, t[0], t[1]) || samePosition(source, t[1], t[2]) || samePosition(source, t[2], t[0]);
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// Keeps the triangles of three different positions, each once; `mesh.dropped` counts the others. In the order of the
/// source, so the lowest source index of a doubled triangle stays.
std::vector<Triangle> keptTriangles(const SourceMesh& source, const std::vector<std::uint32_t>& idOf, Mesh& mesh) {
    std::vector<Triangle> kept;
    kept.reserve(source.triangles.size());
    IndexTable table(source.triangles.size());
    const auto positionsOf = [&](const Triangle& t) { return sorted({idOf[t[0]], idOf[t[1]], idOf[t[2]]}); };
    for (const Triangle& t : source.triangles) {
        const Triangle p = positionsOf(t);
        if (p[0] == p[1] || p[1] == p[2]) {
            ++mesh.dropped[isDegenerate(source, t) ? "degenerate" : "collapsed_by_grid"];
            continue;
        }
        const auto next = static_cast<std::uint32_t>(kept.size());
        const std::uint32_t found = table.findOrInsert(
            hashOf(p[0], p[1], p[2]), next, [&](std::uint32_t other) { return positionsOf(kept[other]) == p; });
        if (found == next)
            kept.push_back(t);
        else
            ++mesh.dropped["doubled"];
    }
    return kept;
}

/// Unites source vertices that agree in position, normal and colour, and drops those that no triangle uses.
void makeVertices(
    const SourceMesh& source,
    const WeldedPositions& welded,
    const std::vector<std::uint32_t>& normals,
    std::vector<Triangle> triangles,
    Mesh& mesh) {
    IndexTable table(source.positions.size());
    std::vector<std::uint32_t> vertexOf(source.positions.size(), kEmpty);
    std::vector<std::uint32_t> usedPosition(welded.points.size(), kEmpty);
    const auto vertexFor = [&](std::uint32_t s) {
        const std::uint32_t position = welded.idOf[s];
        Vertex vertex;
        vertex.position = welded.points[position];
        vertex.normal =
            source.normals.empty() ? normals[position] : hierarchy::packNormal(glm::dvec3(source.normals[s]));
        if (!source.colors.empty()) vertex.color = source.colors[s];
        const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
        const std::uint32_t found =
            table.findOrInsert(hashOf(position, vertex.normal, vertex.color), next, [&](std::uint32_t other) {
                return mesh.vertices[other] == vertex;
            });
        if (found == next) {
            if (usedPosition[position] == kEmpty) usedPosition[position] = mesh.positionCount++;
            mesh.vertices.push_back(vertex);
            mesh.positionOf.push_back(usedPosition[position]);
        }
        return found;
    };
    for (Triangle& t : triangles)
        for (std::uint32_t& corner : t) {
            if (vertexOf[corner] == kEmpty) vertexOf[corner] = vertexFor(corner);
            corner = vertexOf[corner];
        }
    mesh.triangles = std::move(triangles);
}

} // namespace

Grid chooseGrid(const SourceMesh& source) {
    Box box;
    for (const glm::dvec3& p : source.positions)
        box.add(p);
    const glm::dvec3 size = box.extent();
    const double extent = std::max({size.x, size.y, size.z});
    Grid grid;
    if (!(extent > 0)) {
        grid.origin = box.isEmpty() ? glm::dvec3(0) : box.min;
        grid.stepExponent = -20;
        return grid;
    }
    const EdgeHistogram edges(source);
    int exponent = floorExponent(extent * 0x1p-20);
    if (const double median = edges.quantile(0.5); median > 0)
        exponent = std::min(exponent, floorExponent(median / 64));
    if (const double shortest = edges.quantile(2e-5); shortest > 0)
        exponent = std::min(exponent, floorExponent(shortest / 2));
    exponent = std::max(exponent, floorExponent(extent) - 29);
    // A step below the spacing of doubles at these coordinates would only store noise.
    const double largest = std::max(glm::length(box.min), glm::length(box.max));
    exponent = std::max(exponent, floorExponent(largest) - 52);
    grid.stepExponent = exponent;
    grid.origin = glm::floor(box.min / grid.step()) * grid.step();
    return grid;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): takes the mesh over, so that its memory ends with the call.
Mesh weld(SourceMesh source) {
    Mesh mesh;
    mesh.sourceTriangles = source.triangles.size();
    mesh.sourceVertices = source.positions.size();
    for (const char* reason : {"degenerate", "doubled", "not_a_polygon", "collapsed_by_grid"})
        mesh.dropped[reason] = 0;
    mesh.dropped["not_a_polygon"] = source.notAPolygon;
    mesh.hasColors = !source.colors.empty();
    mesh.grid = chooseGrid(source);
    const WeldedPositions welded = weldPositions(snap(source.positions, mesh.grid));
    std::vector<Triangle> kept = keptTriangles(source, welded.idOf, mesh);
    std::vector<std::uint32_t> normals;
    if (source.normals.empty()) {
        std::vector<Triangle> onPositions = kept;
        for (Triangle& t : onPositions)
            t = {welded.idOf[t[0]], welded.idOf[t[1]], welded.idOf[t[2]]};
        normals = smoothNormals(welded.points, onPositions);
    }
    makeVertices(source, welded, normals, std::move(kept), mesh);
    for (const Vertex& vertex : mesh.vertices) {
        mesh.bounds.add(mesh.grid.world(vertex.position));
        mesh.hasNormals = mesh.hasNormals || vertex.normal != hierarchy::kNoNormal;
    }
    return mesh;
}

} // namespace gnomon::preprocess
