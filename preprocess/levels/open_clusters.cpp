#include "preprocess/levels/open_clusters.h"

#include "core/check.h"
#include "core/index_table.h"
#include "hierarchy/bytes.h"
#include "preprocess/levels/local_numbers.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::levels {

namespace {

using hierarchy::GridPoint;
using hierarchy::kNone;
using hierarchy::Vertex;

/// The fixed-size start of an encoded cluster. After it follow the vertices, their fields if there are any, the errors
/// of the triangles, and the triangles (three bytes each).
struct RecordHead {
    LevelRefinement refinement; // its level is kNone if the cluster has no refinement
    std::uint32_t triangleCount = 0;
    std::uint32_t vertexCount = 0;
};

static_assert(std::is_trivially_copyable_v<RecordHead>);

using SmallTriangle = std::array<std::uint8_t, 3>;

std::size_t recordBytes(const simplify::Mesh& mesh, const LevelCluster& cluster) {
    return sizeof(RecordHead) +
           cluster.vertexCount * (sizeof(Vertex) + (mesh.hasFields() ? sizeof(std::uint32_t) : 0)) +
           cluster.triangleCount * (sizeof(simplify::TriangleError) + sizeof(SmallTriangle));
}

template <class T>
void putAll(hierarchy::ByteWriter& out, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.put(std::as_bytes(values));
}

template <class T>
std::vector<T> takeAll(hierarchy::ByteReader& in, std::size_t count) {
    std::vector<T> values(count);
    const auto bytes = in.take(count * sizeof(T));
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

template <class T>
std::vector<T> allFrom(std::span<const std::byte> bytes) {
    GNOMON_CHECK_OP(bytes.size() % sizeof(T), ==, 0U);
    hierarchy::ByteReader in(bytes);
    return takeAll<T>(in, bytes.size() / sizeof(T));
}

RecordHead headOf(std::span<const std::byte> record) {
    RecordHead head;
    GNOMON_CHECK_OP(record.size(), >=, sizeof(head));
    std::memcpy(&head, record.data(), sizeof(head));
    return head;
}

GridPoint centerOf(const hierarchy::GridBox& box) {
    const auto middle = [](std::uint32_t low, std::uint32_t high) { return low + (high - low) / 2; };
    return {middle(box.min.x, box.max.x), middle(box.min.y, box.max.y), middle(box.min.z, box.max.z)};
}

/// Encodes one cluster as a record and appends it to `out`.
void putRecord(
    hierarchy::ByteWriter& out,
    const simplify::Mesh& mesh,
    const Level& level,
    const LevelCluster& cluster,
    LocalNumbers& numbers) {
    RecordHead head;
    head.refinement.place.level = kNone;
    if (cluster.refinement != kNone) head.refinement = level.refinements[cluster.refinement];
    head.triangleCount = cluster.triangleCount;
    head.vertexCount = cluster.vertexCount;
    putAll(out, std::span<const RecordHead>(&head, 1));
    numbers.begin();
    std::vector<SmallTriangle> triangles;
    triangles.reserve(cluster.triangleCount);
    for (const simplify::Triangle& t :
         std::span(level.triangles).subspan(cluster.firstTriangle, cluster.triangleCount)) {
        SmallTriangle& small = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            small.at(i) = static_cast<std::uint8_t>(numbers.of(t[i]));
    }
    GNOMON_CHECK_OP(numbers.ids().size(), ==, cluster.vertexCount);
    std::vector<Vertex> vertices;
    vertices.reserve(cluster.vertexCount);
    for (const std::uint32_t v : numbers.ids())
        vertices.push_back(mesh.vertices[v]);
    putAll(out, std::span<const Vertex>(vertices));
    if (mesh.hasFields())
        for (const std::uint32_t v : numbers.ids())
            out.put(mesh.fieldsOf(v));
    putAll(out, std::span(level.errors).subspan(cluster.firstTriangle, cluster.triangleCount));
    putAll(out, std::span<const SmallTriangle>(triangles));
}

/// Returns the border positions of `mesh` that triangles of `level` use, each once.
std::vector<GridPoint> usedBorders(const simplify::Mesh& mesh, const Level& level) {
    std::vector<GridPoint> borders;
    std::vector<bool> isKnown(mesh.positionCount);
    for (const simplify::Triangle& t : level.triangles)
        for (const std::uint32_t v : t) {
            const std::uint32_t position = mesh.positionOf[v];
            if (mesh.isBorder[position] == 0 || isKnown[position]) continue;
            isKnown[position] = true;
            borders.push_back(mesh.vertices[v].position);
        }
    return borders;
}

} // namespace

EncodedOpenClusters encodeOpenClusters(const simplify::Mesh& mesh, const Level& level) {
    EncodedOpenClusters encoded;
    std::vector<ClusterPlace> places;
    places.reserve(level.clusters.size());
    for (const LevelCluster& cluster : level.clusters) {
        places.push_back(
            {centerOf(cluster.box),
             cluster.triangleCount,
             cluster.vertexCount,
             static_cast<std::uint32_t>(recordBytes(mesh, cluster))});
        encoded.vertices += cluster.vertexCount;
        encoded.triangles += cluster.triangleCount;
    }
    encoded.clusters = places.size();
    hierarchy::ByteWriter out;
    putAll(out, std::span<const ClusterPlace>(places));
    LocalNumbers numbers(mesh.vertices.size());
    for (const LevelCluster& cluster : level.clusters)
        putRecord(out, mesh, level, cluster, numbers);
    putAll(out, std::span<const GridPoint>(usedBorders(mesh, level)));
    encoded.bytes = out.take();
    return encoded;
}

std::vector<ClusterPlace> clusterPlaces(std::span<const std::byte> bytes) {
    return allFrom<ClusterPlace>(bytes);
}

std::vector<GridPoint> positionsFrom(std::span<const std::byte> bytes) {
    return allFrom<GridPoint>(bytes);
}

std::vector<GridPoint> positionsOfRecord(std::span<const std::byte> record) {
    const RecordHead head = headOf(record);
    hierarchy::ByteReader in(record.subspan(sizeof(head)));
    std::vector<GridPoint> positions;
    positions.reserve(head.vertexCount);
    for (const Vertex& vertex : takeAll<Vertex>(in, head.vertexCount))
        positions.push_back(vertex.position);
    return positions;
}

void countPagesFrom(std::span<std::byte> record, std::uint32_t firstLevel, std::span<const std::uint32_t> firstPages) {
    RecordHead head = headOf(record);
    GroupPlace& place = head.refinement.place;
    if (place.level == kNone || place.level < firstLevel) return;
    GNOMON_CHECK_OP(place.level - firstLevel, <, firstPages.size());
    place.page += firstPages[place.level - firstLevel];
    std::memcpy(record.data(), &head, sizeof(head));
}

struct OpenClusterMerger::State {
    State(const hierarchy::Grid& grid, std::size_t clusters, std::size_t count, const hierarchy::FieldLayout& fields)
        : vertices(count), positions(count), refinements(clusters) {
        pending.mesh.grid = grid;
        pending.mesh.fields.layout = fields;
    }

    std::uint32_t positionFor(const GridPoint& p, std::uint64_t place) {
        simplify::Mesh& mesh = pending.mesh;
        const std::uint32_t position =
            positions.findOrInsert(place, mesh.positionCount, [&](std::uint32_t other) { return points[other] == p; });
        if (position == mesh.positionCount) {
            ++mesh.positionCount;
            points.push_back(p);
            mesh.isBorder.push_back(0);
        }
        return position;
    }

    std::uint32_t vertexFor(const Vertex& given, std::uint32_t fields) {
        simplify::Mesh& mesh = pending.mesh;
        const GridPoint& p = given.position;
        const std::uint64_t place = hashOf(p.x, p.y, p.z);
        const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
        const std::uint32_t found = vertices.findOrInsert(
            mix64(place ^ hashOf(given.normal, given.color, fields)), next, [&](std::uint32_t other) {
                return mesh.vertices[other] == given && mesh.fieldsOf(other) == fields;
            });
        if (found != next) return found;
        mesh.vertices.push_back(given);
        if (mesh.hasFields()) mesh.fields.words.push_back(fields);
        mesh.positionOf.push_back(positionFor(p, place));
        return found;
    }

    /// Returns the index of the refinement `given` in the merged level, and adds it if needed. Clusters of the same
    /// finer group share one refinement.
    std::uint32_t refinementFor(const LevelRefinement& given) {
        if (given.place.level == kNone) return kNone;
        std::vector<LevelRefinement>& known = pending.level.refinements;
        const auto next = static_cast<std::uint32_t>(known.size());
        const std::uint32_t found = refinements.findOrInsert(
            hashOf(given.place.level, given.place.page, given.place.group), next, [&](std::uint32_t other) {
                return known[other].place == given.place;
            });
        if (found == next) known.push_back(given);
        return found;
    }

    void addRecord(hierarchy::ByteReader& in) {
        const simplify::Mesh& mesh = pending.mesh;
        Level& level = pending.level;
        const RecordHead head = headOf(in.take(sizeof(RecordHead)));
        LevelCluster cluster;
        cluster.firstTriangle = static_cast<std::uint32_t>(level.triangles.size());
        cluster.triangleCount = head.triangleCount;
        cluster.refinement = refinementFor(head.refinement);
        numbers.clear();
        const auto corners = takeAll<Vertex>(in, head.vertexCount);
        const auto fields = takeAll<std::uint32_t>(in, mesh.hasFields() ? head.vertexCount : 0);
        for (std::size_t v = 0; v < corners.size(); ++v) {
            numbers.push_back(vertexFor(corners[v], fields.empty() ? 0 : fields[v]));
            cluster.box.add(mesh.vertices[numbers.back()].position);
        }
        const auto errors = takeAll<simplify::TriangleError>(in, head.triangleCount);
        level.errors.insert(level.errors.end(), errors.begin(), errors.end());
        for (const SmallTriangle& t : takeAll<SmallTriangle>(in, head.triangleCount))
            level.triangles.push_back({numbers.at(t[0]), numbers.at(t[1]), numbers.at(t[2])});
        // Vertices whose colours or normals became equal during the build have one index, so they count only once.
        std::sort(numbers.begin(), numbers.end());
        const auto end = std::unique(numbers.begin(), numbers.end());
        cluster.vertexCount = static_cast<std::uint32_t>(end - numbers.begin());
        level.clusters.push_back(cluster);
    }

    OpenClusters pending;
    IndexTable vertices;
    IndexTable positions;
    IndexTable refinements;
    std::vector<GridPoint> points;      // one per position
    std::vector<std::uint32_t> numbers; // vertices of the current record
};

OpenClusterMerger::OpenClusterMerger(
    const hierarchy::Grid& grid, std::size_t clusters, std::size_t vertices, const hierarchy::FieldLayout& fields)
    : state_(std::make_unique<State>(grid, clusters, vertices, fields)) {}

OpenClusterMerger::~OpenClusterMerger() = default;

void OpenClusterMerger::add(std::span<const std::byte> records) {
    hierarchy::ByteReader in(records);
    while (in.remaining() > 0)
        state_->addRecord(in);
}

void OpenClusterMerger::lock(const GridPoint& position) {
    const std::uint32_t found =
        state_->positions.find(hashOf(position.x, position.y, position.z), [&](std::uint32_t other) {
            return state_->points[other] == position;
        });
    GNOMON_CHECK_OP(found, !=, IndexTable::kAbsent);
    state_->pending.mesh.isBorder[found] = 1;
}

OpenClusters OpenClusterMerger::take() {
    return std::move(state_->pending);
}

} // namespace gnomon::levels
