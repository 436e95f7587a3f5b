#include "preprocess/levels/pending_level.h"

#include "core/index_table.h"
#include "hierarchy/bytes.h"

#include <algorithm>
#include <cstring>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

/// Numbers things in the order in which they are first asked for.
class Renumbering {
public:
    explicit Renumbering(std::size_t count) : numbers_(count, kNone) {}

    std::uint32_t operator()(std::uint32_t old) {
        if (numbers_[old] == kNone) {
            numbers_[old] = static_cast<std::uint32_t>(inOrder_.size());
            inOrder_.push_back(old);
        }
        return numbers_[old];
    }

    const std::vector<std::uint32_t>& inOrder() const { return inOrder_; }

private:
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint32_t> inOrder_;
};

/// A vertex, with who shares its position.
struct PendingVertex {
    hierarchy::Vertex vertex;
    simplify::ChunkSpan sharers;
};

struct PendingCluster {
    std::uint32_t triangleCount = 0;
    std::uint32_t refinement = kNone;
};

template <class T>
void putAll(hierarchy::ByteWriter& out, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.putVarint(values.size());
    out.put(std::as_bytes(std::span(values)));
}

template <class T>
std::vector<T> takeAll(hierarchy::ByteReader& in) {
    std::vector<T> values(in.takeVarint());
    const auto bytes = in.take(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

} // namespace

EncodedPendingLevel encodePendingLevel(const simplify::Mesh& mesh, const Level& level) {
    Renumbering vertexNumbers(mesh.vertices.size());
    Renumbering refinementNumbers(level.refinements.size());
    std::vector<simplify::Triangle> triangles = level.triangles;
    for (simplify::Triangle& t : triangles)
        for (std::uint32_t& corner : t)
            corner = vertexNumbers(corner);
    std::vector<PendingCluster> clusters;
    clusters.reserve(level.clusters.size());
    for (const LevelCluster& c : level.clusters)
        clusters.push_back({c.triangleCount, c.refinement == kNone ? kNone : refinementNumbers(c.refinement)});
    std::vector<PendingVertex> vertices;
    vertices.reserve(vertexNumbers.inOrder().size());
    for (const std::uint32_t v : vertexNumbers.inOrder())
        vertices.push_back({mesh.vertices[v], mesh.sharers[mesh.positionOf[v]]});
    hierarchy::ByteWriter out;
    out.put(mesh.chunks.first);
    out.put(mesh.chunks.last);
    putAll(out, vertices);
    putAll(out, triangles);
    putAll(out, level.errors);
    putAll(out, clusters);
    out.putVarint(refinementNumbers.inOrder().size());
    for (const std::uint32_t r : refinementNumbers.inOrder()) {
        const LevelRefinement& refinement = level.refinements[r];
        out.putVarint(refinement.place.level);
        out.putVarint(refinement.place.page);
        out.putVarint(refinement.place.group);
        for (int axis = 0; axis < 3; ++axis)
            out.put(refinement.bounds.center[axis]);
        out.put(refinement.bounds.radius);
        out.put(refinement.error);
        out.put(refinement.attributeError);
    }
    return {out.take(), vertices.size(), triangles.size()};
}

struct PendingLevelMerger::State {
    State(const hierarchy::Grid& grid, std::size_t count) : vertices(count), positions(count) {
        pending.mesh.grid = grid;
    }

    std::uint32_t vertexFor(const PendingVertex& given) {
        simplify::Mesh& mesh = pending.mesh;
        const hierarchy::GridPoint& p = given.vertex.position;
        const std::uint64_t place = hashOf(p.x, p.y, p.z);
        const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
        const std::uint32_t found = vertices.findOrInsert(
            mix64(place ^ hashOf(given.vertex.normal, given.vertex.color, 0)), next, [&](std::uint32_t other) {
                return mesh.vertices[other] == given.vertex;
            });
        if (found != next) return found;
        const std::uint32_t position =
            positions.findOrInsert(place, mesh.positionCount, [&](std::uint32_t other) { return points[other] == p; });
        if (position == mesh.positionCount) {
            ++mesh.positionCount;
            points.push_back(p);
            mesh.sharers.push_back(given.sharers);
        }
        mesh.vertices.push_back(given.vertex);
        mesh.positionOf.push_back(position);
        return found;
    }

    PendingLevel pending;
    IndexTable vertices;
    IndexTable positions;
    std::vector<hierarchy::GridPoint> points; // of the positions
    bool isEmpty = true;
};

PendingLevelMerger::PendingLevelMerger(const hierarchy::Grid& grid, std::size_t vertices)
    : state_(std::make_unique<State>(grid, vertices)) {}

PendingLevelMerger::~PendingLevelMerger() = default;

void PendingLevelMerger::add(
    std::span<const std::byte> bytes, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages) {
    hierarchy::ByteReader in(bytes);
    simplify::Mesh& mesh = state_->pending.mesh;
    Level& level = state_->pending.level;
    simplify::ChunkSpan chunks;
    chunks.first = in.take<std::uint16_t>();
    chunks.last = in.take<std::uint16_t>();
    if (state_->isEmpty) mesh.chunks = chunks;
    mesh.chunks.add(chunks);
    state_->isEmpty = false;
    std::vector<std::uint32_t> vertexOf;
    for (const PendingVertex& vertex : takeAll<PendingVertex>(in))
        vertexOf.push_back(state_->vertexFor(vertex));
    const auto firstTriangle = static_cast<std::uint32_t>(level.triangles.size());
    for (const simplify::Triangle& t : takeAll<simplify::Triangle>(in))
        level.triangles.push_back({vertexOf[t[0]], vertexOf[t[1]], vertexOf[t[2]]});
    const auto errors = takeAll<simplify::TriangleError>(in);
    level.errors.insert(level.errors.end(), errors.begin(), errors.end());
    const auto firstRefinement = static_cast<std::uint32_t>(level.refinements.size());
    std::uint32_t triangle = firstTriangle;
    std::vector<std::uint32_t> corners; // of one cluster, each once
    for (const PendingCluster& given : takeAll<PendingCluster>(in)) {
        LevelCluster cluster;
        cluster.firstTriangle = triangle;
        cluster.triangleCount = given.triangleCount;
        if (given.refinement != kNone) cluster.refinement = firstRefinement + given.refinement;
        corners.clear();
        for (const std::uint32_t end = triangle + given.triangleCount; triangle < end; ++triangle)
            corners.insert(corners.end(), level.triangles[triangle].begin(), level.triangles[triangle].end());
        // Vertices whose colours or normals became the same on the way are one from here on.
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        cluster.vertexCount = static_cast<std::uint32_t>(corners.size());
        for (const std::uint32_t v : corners)
            cluster.box.add(mesh.vertices[v].position);
        level.clusters.push_back(cluster);
    }
    const std::uint64_t refinements = in.takeVarint();
    for (std::uint64_t i = 0; i < refinements; ++i) {
        LevelRefinement refinement;
        refinement.place.level = static_cast<std::uint32_t>(in.takeVarint());
        refinement.place.page = static_cast<std::uint32_t>(in.takeVarint());
        refinement.place.group = static_cast<std::uint32_t>(in.takeVarint());
        if (refinement.place.level >= firstLevel)
            refinement.place.page += firstPages[refinement.place.level - firstLevel];
        for (int axis = 0; axis < 3; ++axis)
            refinement.bounds.center[axis] = in.take<double>();
        refinement.bounds.radius = in.take<double>();
        refinement.error = in.take<double>();
        refinement.attributeError = in.take<double>();
        level.refinements.push_back(refinement);
    }
    in.expectEnd();
}

PendingLevel PendingLevelMerger::take() {
    return std::move(state_->pending);
}

} // namespace gnomon::levels
