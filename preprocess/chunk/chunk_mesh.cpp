#include "preprocess/chunk/chunk_mesh.h"

#include "core/check.h"
#include "core/index_table.h"
#include "preprocess/levels/smooth_normals.h"
#include "preprocess/read/polygon.h"

namespace gnomon::chunk {

namespace {

using hierarchy::kNone;

/// Triangulates a polygon of the source. `fan` contains its preliminary triangles, and receives the final triangles.
void refine(const IndexedVertices& vertices, read::PolygonRefiner& refiner, std::span<simplify::Triangle> fan) {
    std::vector<read::TriangleCorners> wide;
    wide.reserve(fan.size());
    for (const simplify::Triangle& t : fan)
        wide.push_back({t[0], t[1], t[2]});
    refiner.refine(wide, [&](std::uint64_t vertex) { return vertices[static_cast<std::uint32_t>(vertex)].position; });
    for (std::size_t i = 0; i < fan.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            fan[i][k] = static_cast<std::uint32_t>(wide[i][k]);
}

/// The normals and border flags of a mesh, one per place (welded position).
struct Places {
    std::vector<std::uint32_t> normals; // empty if the source has normals
    std::vector<std::uint8_t> isShared;
};

Places placesOf(
    const BinnedSource& source,
    const scratch::StreamStore& borders,
    std::uint32_t chunk,
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& faces) {
    Places places;
    if (!source.format.hasNormals) places.normals = levels::smoothNormals(vertices.places(), faces);
    places.isShared =
        sharedPlaces(vertices, readRequests(source.bins, streamOf(BinStream::Requests, chunk), source.format));
    for (const SharedNormal& shared : readNormals(borders, streamOf(BorderStream::Normals, chunk), source.format))
        places.normals[vertices.placeOfSource(shared.vertex)] = shared.normal;
    return places;
}

/// Builds the mesh of a chunk. It merges source vertices with equal position, normal and colour, and removes unused
/// vertices.
class MeshMaker {
public:
    /// Prepares a mesh of at most `triangleCount` triangles.
    MeshMaker(
        const ChunkVertices& vertices,
        const Places& places,
        const hierarchy::FieldLayout& fields,
        std::size_t triangleCount)
        : vertices_(vertices),
          places_(places),
          vertexOf_(vertices.size(), kNone),
          firstAt_(vertices.places().size(), kNone),
          furtherAt_(std::min(vertices.size() - vertices.places().size(), 3 * triangleCount)) {
        mesh_.fields.layout = fields;
    }

    void add(std::vector<simplify::Triangle> triangles) {
        for (simplify::Triangle& t : triangles)
            for (std::uint32_t& corner : t) {
                if (vertexOf_[corner] == kNone) vertexOf_[corner] = vertexFor(corner);
                corner = vertexOf_[corner];
            }
        mesh_.triangles = std::move(triangles);
    }

    simplify::Mesh take() { return std::move(mesh_); }

private:
    std::uint32_t vertexFor(std::uint32_t source) {
        const std::uint32_t place = vertices_.placeOf(source);
        hierarchy::Vertex vertex;
        vertex.position = vertices_.places()[place];
        vertex.normal = places_.normals.empty() ? vertices_[source].normal : places_.normals[place];
        vertex.color = vertices_[source].color;
        const std::uint32_t fields = vertices_[source].fields;
        const std::uint32_t first = firstAt_[place];
        const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
        if (first == kNone) {
            firstAt_[place] = next;
            mesh_.positionOf.push_back(mesh_.positionCount++);
            mesh_.isBorder.push_back(places_.isShared[place]);
        } else {
            const auto isEqual = [&](std::uint32_t other) {
                return mesh_.vertices[other] == vertex && mesh_.fieldsOf(other) == fields;
            };
            if (isEqual(first)) return first;
            const std::uint32_t found =
                furtherAt_.findOrInsert(hashOf(place, vertex.normal, vertex.color ^ fields), next, isEqual);
            if (found != next) return found;
            mesh_.positionOf.push_back(mesh_.positionOf[first]);
        }
        mesh_.vertices.push_back(vertex);
        if (mesh_.hasFields()) mesh_.fields.words.push_back(fields);
        return next;
    }

    const ChunkVertices& vertices_;
    const Places& places_;
    std::vector<std::uint32_t> vertexOf_;
    std::vector<std::uint32_t> firstAt_; // the first mesh vertex at each welded position, usually the only one
    IndexTable furtherAt_;               // more mesh vertices at a position, if their normals or colours differ
    simplify::Mesh mesh_;
};

} // namespace

IndexedVertices readVertices(const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk) {
    const std::uint32_t own = streamOf(BinStream::Vertices, chunk);
    const std::uint32_t foreign = streamOf(BorderStream::Vertices, chunk);
    std::vector<ChunkVertex> vertices;
    vertices.reserve((source.bins.bytes(own) + borders.bytes(foreign)) / source.format.bytes());
    appendVertices(source.bins, own, source.format, vertices);
    const std::size_t ownCount = vertices.size();
    appendVertices(borders, foreign, source.format, vertices);
    return {std::move(vertices), ownCount};
}

ChunkTriangles readTriangles(
    const BinnedSource& source, std::uint32_t chunk, const IndexedVertices& vertices, Progress& progress) {
    ChunkTriangles triangles;
    const std::uint32_t own = streamOf(BinStream::Triangles, chunk);
    const std::uint32_t ghosts = streamOf(BinStream::Ghosts, chunk);
    triangles.own.reserve(triangleRecords(source.bins, own, source.format));
    read::PolygonRefiner refiner(progress);
    std::size_t fan = 0;  // number of triangles of the current polygon
    std::size_t left = 0; // number of triangles of the current polygon that are not read yet
    forEachTriangle(source.bins, own, source.format, [&](const read::TriangleCorners& corners) {
        if (left == 0 && corners[0] == kPolygonMark) {
            fan = left = corners[1];
            return;
        }
        triangles.own.push_back(vertices.find(corners));
        if (left > 0 && --left == 0) refine(vertices, refiner, std::span(triangles.own).last(fan));
    });
    GNOMON_CHECK_OP(left, ==, 0U);
    triangles.ghosts.reserve(triangleRecords(source.bins, ghosts, source.format));
    forEachTriangle(source.bins, ghosts, source.format, [&](const read::TriangleCorners& corners) {
        triangles.ghosts.push_back(vertices.find(corners));
    });
    return triangles;
}

std::vector<simplify::Triangle> facesForNormals(
    const ChunkVertices& vertices,
    const std::vector<simplify::Triangle>& own,
    const std::vector<simplify::Triangle>& ghosts) {
    std::vector<simplify::Triangle> faces;
    faces.reserve(own.size() + ghosts.size());
    for (const simplify::Triangle& t : own)
        faces.push_back(vertices.placesOf(t));
    for (const simplify::Triangle& t : ghosts)
        faces.push_back(vertices.placesOf(t));
    return faces;
}

ChunkMesh loadChunk(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress) {
    ChunkMesh result;
    const ChunkVertices vertices(readVertices(source, borders, chunk), source.grid);
    std::vector<simplify::Triangle> kept;
    Places places;
    {
        const ChunkTriangles triangles = readTriangles(source, chunk, vertices.indexed(), progress);
        kept = keptTriangles(vertices, triangles.own, result.dropped);
        std::vector<simplify::Triangle> faces;
        DroppedTriangles ignored;
        if (!source.format.hasNormals)
            faces = facesForNormals(vertices, kept, keptTriangles(vertices, triangles.ghosts, ignored));
        places = placesOf(source, borders, chunk, vertices, faces);
    }
    MeshMaker maker(vertices, places, source.format.fields, kept.size());
    maker.add(std::move(kept));
    result.mesh = maker.take();
    result.mesh.grid = source.grid;
    for (const hierarchy::Vertex& vertex : result.mesh.vertices) {
        result.bounds.add(source.grid.world(vertex.position));
        result.hasNormals = result.hasNormals || vertex.normal != hierarchy::kNoNormal;
    }
    return result;
}

} // namespace gnomon::chunk
