#include "preprocess/chunk/chunk_streams.h"

#include "core/check.h"

namespace gnomon::chunk {

namespace {

template <class T>
std::byte* put(std::byte* place, const T& value) {
    std::memcpy(place, &value, sizeof(T));
    return place + sizeof(T);
}

template <class T>
const std::byte* take(const std::byte* place, T& value) {
    std::memcpy(&value, place, sizeof(T));
    return place + sizeof(T);
}

std::byte* putNumber(std::byte* place, std::uint64_t vertex, const VertexFormat& format) {
    return format.isWide ? put(place, vertex) : put(place, static_cast<std::uint32_t>(vertex));
}

const std::byte* takeNumber(const std::byte* place, std::uint64_t& vertex, const VertexFormat& format) {
    if (format.isWide) return take(place, vertex);
    std::uint32_t narrow = 0;
    place = take(place, narrow);
    vertex = narrow;
    return place;
}

constexpr std::size_t kMaxRecordBytes = 16;

std::size_t requestBytes(const VertexFormat& format) {
    return (format.isWide ? 8 : 4) + 8;
}

std::size_t normalBytes(const VertexFormat& format) {
    return (format.isWide ? 8 : 4) + 4;
}

const std::byte* takeVertex(const std::byte* place, const VertexFormat& format, ChunkVertex& vertex) {
    place = takeNumber(place, vertex.index, format);
    if (format.isDouble) {
        place = take(place, vertex.position);
    } else {
        glm::vec3 position;
        place = take(place, position);
        vertex.position = glm::dvec3(position);
    }
    if (format.hasNormals) place = take(place, vertex.normal);
    if (format.hasColors) place = take(place, vertex.color);
    if (format.hasFields()) place = take(place, vertex.fields);
    return place;
}

} // namespace

std::span<const std::byte> encodeVertex(const ChunkVertex& vertex, const VertexFormat& format, VertexBytes& storage) {
    std::byte* place = putNumber(storage.data(), vertex.index, format);
    if (format.isDouble)
        place = put(place, vertex.position);
    else
        place = put(place, glm::vec3(vertex.position));
    if (format.hasNormals) place = put(place, vertex.normal);
    if (format.hasColors) place = put(place, vertex.color);
    if (format.hasFields()) place = put(place, vertex.fields);
    return std::span(storage).first(static_cast<std::size_t>(place - storage.data()));
}

void decodeVertices(
    std::span<const std::byte> records, const VertexFormat& format, std::vector<ChunkVertex>& vertices) {
    GNOMON_CHECK_OP(records.size() % format.bytes(), ==, 0U);
    for (const std::byte* place = records.data(); place != records.data() + records.size();)
        place = takeVertex(place, format, vertices.emplace_back());
}

void appendVertices(
    const scratch::StreamStore& store,
    std::uint32_t stream,
    const VertexFormat& format,
    std::vector<ChunkVertex>& vertices) {
    const std::size_t end = vertices.size() + store.bytes(stream) / format.bytes();
    vertices.reserve(end);
    store.readBlocks(stream, [&](std::span<const std::byte> records) { decodeVertices(records, format, vertices); });
    GNOMON_CHECK_OP(vertices.size(), ==, end);
}

std::uint64_t triangleRecords(const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format) {
    return store.bytes(stream) / (format.isWide ? sizeof(read::TriangleCorners) : sizeof(simplify::Triangle));
}

void putRequest(
    scratch::StreamStore& store, std::uint32_t stream, const VertexRequest& request, const VertexFormat& format) {
    std::array<std::byte, kMaxRecordBytes> storage{};
    std::byte* place = put(put(storage.data(), request.chunk), request.isOwner);
    putNumber(place, request.vertex, format);
    store.append(stream, std::span(storage).first(requestBytes(format)));
}

std::vector<VertexRequest> readRequests(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format) {
    std::vector<VertexRequest> requests;
    requests.reserve(store.bytes(stream) / requestBytes(format));
    store.readBlocks(stream, [&](std::span<const std::byte> records) {
        for (const std::byte* place = records.data(); place != records.data() + records.size();) {
            VertexRequest& request = requests.emplace_back();
            place = take(take(place, request.chunk), request.isOwner);
            place = takeNumber(place, request.vertex, format);
        }
    });
    return requests;
}

void appendNormal(std::vector<std::byte>& bytes, const SharedNormal& normal, const VertexFormat& format) {
    std::array<std::byte, kMaxRecordBytes> storage{};
    putNumber(put(storage.data(), normal.normal), normal.vertex, format);
    bytes.insert(bytes.end(), storage.begin(), storage.begin() + static_cast<std::ptrdiff_t>(normalBytes(format)));
}

std::vector<SharedNormal> readNormals(
    const scratch::StreamStore& store, std::uint32_t stream, const VertexFormat& format) {
    std::vector<SharedNormal> normals;
    normals.reserve(store.bytes(stream) / normalBytes(format));
    store.readBlocks(stream, [&](std::span<const std::byte> records) {
        for (const std::byte* place = records.data(); place != records.data() + records.size();) {
            SharedNormal& normal = normals.emplace_back();
            place = take(place, normal.normal);
            place = takeNumber(place, normal.vertex, format);
        }
    });
    return normals;
}

} // namespace gnomon::chunk
