#include "preprocess/chunk/borders.h"

#include "core/check.h"
#include "preprocess/build/normals.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/chunk/in_order.h"

#include <algorithm>

namespace gnomon::preprocess {

namespace {

/// Bytes for the streams of other chunks.
struct Message {
    std::uint32_t chunk = 0;
    std::vector<std::byte> bytes;
};

using Messages = std::vector<Message>;

/// The message to `chunk`, which is the last or a new one: messages come by ascending chunk.
std::vector<std::byte>& messageTo(Messages& messages, std::uint32_t chunk) {
    if (messages.empty() || messages.back().chunk != chunk) messages.push_back({chunk, {}});
    return messages.back().bytes;
}

Messages answerVertices(const BinnedSource& source, std::uint32_t chunk) {
    auto requests = source.bins.readAs<VertexRequest>(streamOf(BinStream::Requests, chunk));
    for (VertexRequest& request : requests)
        request.isOwner = 0;
    std::sort(requests.begin(), requests.end());
    requests.erase(std::unique(requests.begin(), requests.end()), requests.end());
    const auto vertices = decodeVertices(source.bins.read(streamOf(BinStream::Vertices, chunk)), source.format);
    Messages messages;
    VertexBytes storage{};
    for (const VertexRequest& request : requests) {
        const auto found = std::lower_bound(
            vertices.begin(), vertices.end(), request.vertex, [](const ChunkVertex& vertex, std::uint32_t index) {
                return vertex.index < index;
            });
        GNOMON_CHECK(found != vertices.end() && found->index == request.vertex);
        const auto record = encodeVertex(*found, source.format, storage);
        std::vector<std::byte>& bytes = messageTo(messages, request.chunk);
        bytes.insert(bytes.end(), record.begin(), record.end());
    }
    return messages;
}

/// The normals of places, right for the `wanted` ones alone.
std::vector<std::uint32_t> normalsOf(
    const BinnedSource& source,
    std::uint32_t chunk,
    const ChunkVertices& vertices,
    const std::vector<std::uint8_t>& wanted) {
    ChunkTriangles triangles = readTriangles(source, chunk, vertices);
    const auto isElsewhere = [&](const Triangle& t) {
        const Triangle p = vertices.placesOf(t);
        return wanted[p[0]] == 0 && wanted[p[1]] == 0 && wanted[p[2]] == 0;
    };
    std::erase_if(triangles.own, isElsewhere);
    std::erase_if(triangles.ghosts, isElsewhere);
    DroppedTriangles ignored;
    return smoothNormals(
        vertices.places(),
        facesForNormals(
            vertices,
            keptTriangles(vertices, triangles.own, ignored),
            keptTriangles(vertices, triangles.ghosts, ignored)));
}

Messages answerShared(const BinnedSource& source, const StreamStore& borders, std::uint32_t chunk) {
    auto requests = source.bins.readAs<VertexRequest>(streamOf(BinStream::Requests, chunk));
    std::erase_if(requests, [](const VertexRequest& request) { return request.isOwner == 0; });
    std::sort(requests.begin(), requests.end());
    requests.erase(std::unique(requests.begin(), requests.end()), requests.end());
    Messages messages;
    if (requests.empty()) return messages;
    const ChunkVertices vertices = readVertices(source, borders, chunk);
    const std::vector<ChunkSpan> sharers = sharersOfOwnPlaces(vertices, chunk, requests);
    std::vector<std::uint32_t> normals;
    if (!source.format.hasNormals) {
        std::vector<std::uint8_t> wanted(vertices.places().size(), 0);
        for (const VertexRequest& request : requests)
            wanted[vertices.placeOf(vertices.find(request.vertex))] = 1;
        normals = normalsOf(source, chunk, vertices, wanted);
    }
    for (const VertexRequest& request : requests) {
        const std::uint32_t place = vertices.placeOf(vertices.find(request.vertex));
        SharedVertex answer{request.vertex, hierarchy::kNoNormal, sharers[place]};
        if (!normals.empty()) answer.normal = normals[place];
        const auto record = std::as_bytes(std::span(&answer, 1));
        std::vector<std::byte>& bytes = messageTo(messages, request.chunk);
        bytes.insert(bytes.end(), record.begin(), record.end());
    }
    return messages;
}

} // namespace

void shareBorders(const BinnedSource& source, StreamStore& borders, std::size_t atOnce, Progress& progress) {
    progress.stage("borders", "chunks", std::uint64_t{2} * source.chunkCount);
    const auto deliver = [&](BorderStream kind) {
        return [&, kind](std::size_t, const Messages& messages) {
            for (const Message& message : messages)
                borders.append(streamOf(kind, message.chunk), message.bytes);
            progress.advance(1);
        };
    };
    makeInOrder(
        0,
        source.chunkCount,
        atOnce,
        [&](std::size_t chunk) { return answerVertices(source, static_cast<std::uint32_t>(chunk)); },
        deliver(BorderStream::Vertices));
    borders.flush();
    makeInOrder(
        0,
        source.chunkCount,
        atOnce,
        [&](std::size_t chunk) { return answerShared(source, borders, static_cast<std::uint32_t>(chunk)); },
        deliver(BorderStream::Shared));
    borders.flush();
}

} // namespace gnomon::preprocess
