#include "preprocess/exporter/tiles/tile_mesh.h"

#include "hierarchy/octahedral.h"
#include "preprocess/exporter/export.h"

#include <algorithm>
#include <cmath>

namespace gnomon::exporter {

using namespace hierarchy;

namespace {

ClippedCorner cornerOf(const Vertex& vertex, const glm::dvec3& faceNormal) {
    const glm::dvec3 stored = unpackNormal(vertex.normal);
    const glm::dvec3 normal = stored != glm::dvec3(0) ? stored : faceNormal;
    ClippedCorner corner;
    corner.place = {double(vertex.position.x), double(vertex.position.y), double(vertex.position.z)};
    corner.normal = {normal.x, normal.y, normal.z};
    for (std::size_t i = 0; i < 4; ++i)
        corner.color[i] = vertex.color >> 8 * i & 255U;
    return corner;
}

std::uint32_t coordinate(double value) {
    return static_cast<std::uint32_t>(std::clamp(std::round(value), 0.0, double(kMaxGridCoordinate)));
}

class TileBuilder {
public:
    TileBuilder(const TileCell& cell, double skirt, const ModelSummary& summary)
        : cell_(cell), skirt_(skirt), hasNormals_(summary.hasNormals) {}

    void add(const Page& page, const Cluster& cluster) {
        known_.assign(cluster.vertexCount, kNone);
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            const Triangle& triangle = page.triangles[cluster.firstTriangle + t];
            std::array<const Vertex*, 3> vertices{};
            std::array<glm::dvec3, 3> places{};
            for (std::size_t k = 0; k < 3; ++k) {
                vertices[k] = &page.vertices[cluster.firstVertex + triangle[k]];
                const GridPoint& p = vertices[k]->position;
                places[k] = {p.x, p.y, p.z};
            }
            const glm::dvec3 across = glm::cross(places[1] - places[0], places[2] - places[0]);
            const double length = glm::length(across);
            if (!(length > 0)) continue;
            const glm::dvec3 normal = across / length;
            if (std::all_of(vertices.begin(), vertices.end(), [this](const Vertex* v) { return isWithin(*v); })) {
                // Separate statements create the vertices in corner order, because C++ does not specify in which order
                // arguments are evaluated.
                std::array<std::uint32_t, 3> made{};
                for (std::size_t k = 0; k < 3; ++k)
                    made[k] = knownVertex(triangle[k], *vertices[k], normal);
                addTriangle(made[0], made[1], made[2]);
                continue;
            }
            std::array<ClippedCorner, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = cornerOf(*vertices[k], normal);
            addPolygon(clipped(corners, cell_));
        }
    }

    CutMesh take() {
        weld(mesh_);
        return std::move(mesh_);
    }

private:
    /// Returns true if `vertex` is strictly inside the tile's cell. A triangle with three such vertices is not clipped
    /// and has no skirt.
    bool isWithin(const Vertex& vertex) const {
        const GridPoint& p = vertex.position;
        const auto isBetween = [this](std::size_t axis, std::uint32_t value) {
            return value > cell_.low[axis] && value < cell_.low[axis] + cell_.side;
        };
        return isBetween(0, p.x) && isBetween(1, p.y) && isBetween(2, p.z);
    }

    /// Returns the vertex of the tile's mesh for vertex `number` of the current cluster. If the vertex has a normal, or
    /// the mesh has no normals, the vertex is created only once. Otherwise each face creates a copy with the face's
    /// normal.
    std::uint32_t knownVertex(std::uint8_t number, const Vertex& vertex, const glm::dvec3& faceNormal) {
        if (known_[number] != kNone) return known_[number];
        const std::uint32_t made = addVertex(cornerOf(vertex, faceNormal), 0);
        if (!hasNormals_ || vertex.normal != kNoNormal) known_[number] = made;
        return made;
    }

    std::uint32_t addVertex(const ClippedCorner& corner, double down) {
        const glm::dvec3 normal(corner.normal[0], corner.normal[1], corner.normal[2]);
        const double length = glm::length(normal);
        const glm::dvec3 unit = length > 0 ? normal / length : glm::dvec3(0);
        const auto at = [&](std::size_t i) { return coordinate(corner.place[i] - down * unit[static_cast<int>(i)]); };
        Vertex vertex;
        vertex.position = {at(0), at(1), at(2)};
        if (hasNormals_ && length > 0) vertex.normal = packNormal(unit);
        vertex.color = 0;
        for (std::size_t i = 4; i-- > 0;)
            vertex.color =
                vertex.color << 8U | static_cast<std::uint32_t>(std::lround(std::clamp(corner.color[i], 0.0, 255.0)));
        mesh_.vertices.push_back(vertex);
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& v = mesh_.vertices;
        if (v[a].position == v[b].position || v[b].position == v[c].position || v[c].position == v[a].position) return;
        mesh_.triangles.push_back({a, b, c});
    }

    void addPolygon(const std::vector<ClippedCorner>& corners) {
        std::vector<std::uint32_t> top;
        top.reserve(corners.size());
        for (const ClippedCorner& corner : corners)
            top.push_back(addVertex(corner, 0));
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            addTriangle(top[0], top[i], top[i + 1]);
        if (!(skirt_ > 0)) return;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::size_t next = (i + 1) % corners.size();
            if (!liesOnSide(corners[i], corners[next], cell_)) continue;
            const std::uint32_t a = addVertex(corners[i], skirt_);
            const std::uint32_t b = addVertex(corners[next], skirt_);
            addTriangle(top[i], a, top[next]);
            addTriangle(top[next], a, b);
        }
    }

    TileCell cell_;
    double skirt_;
    bool hasNormals_;
    CutMesh mesh_;
    // The vertex in the tile's mesh for each vertex of the current cluster. The value is kNone if there is none yet.
    std::vector<std::uint32_t> known_;
};

std::uint64_t bytesOf(const Page& page) {
    return page.vertices.size() * sizeof(Vertex) + page.triangles.size() * sizeof(Triangle) +
           page.clusters.size() * sizeof(Cluster) + page.groups.size() * sizeof(Group);
}

} // namespace

const Page& PageCache::page(std::uint32_t number) {
    const auto found = places_.find(number);
    if (found != places_.end()) {
        held_.splice(held_.begin(), held_, found->second);
        return held_.front().page;
    }
    Held held{number, 0, file_.readPage(number)};
    held.bytes = bytesOf(held.page);
    while (!held_.empty() && bytes_ + held.bytes > limit_.count) {
        bytes_ -= held_.back().bytes;
        places_.erase(held_.back().number);
        held_.pop_back();
    }
    bytes_ += held.bytes;
    held_.push_front(std::move(held));
    places_[number] = held_.begin();
    return held_.front().page;
}

CutMesh tileMesh(
    std::span<const TileCluster* const> clusters,
    const TileCell& cell,
    double skirt,
    const ModelSummary& summary,
    PageCache& pages) {
    TileBuilder builder(cell, skirt, summary);
    for (const TileCluster* cluster : clusters) {
        const Page& page = pages.page(cluster->page);
        builder.add(page, page.clusters[cluster->cluster]);
    }
    return builder.take();
}

} // namespace gnomon::exporter
