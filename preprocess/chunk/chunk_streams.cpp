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

const std::byte* takeVertex(const std::byte* place, const VertexFormat& format, ChunkVertex& vertex) {
    place = take(place, vertex.index);
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
    std::byte* place = put(storage.data(), vertex.index);
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

} // namespace gnomon::chunk
