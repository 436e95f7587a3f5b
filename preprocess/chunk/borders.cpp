#include "preprocess/chunk/borders.h"

#include "core/check.h"
#include "core/index_table.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/chunk/survey.h"
#include "preprocess/levels/smooth_normals.h"

#include <algorithm>

namespace gnomon::chunk {

namespace {

/// Returns the bytes of the message to `chunk`. Appends a new message if the last message is to another chunk. The
/// caller adds messages in ascending order of the chunks.
std::vector<std::byte>& messageTo(Messages& messages, std::uint32_t chunk) {
    if (messages.empty() || messages.back().chunk != chunk) messages.push_back({chunk, {}});
    return messages.back().bytes;
}

/// The vertices and triangles that affect the normals that a chunk sends to other chunks.
struct Surroundings {
    ChunkVertices vertices;   // vertices that other chunks requested, and corners of triangles
    ChunkTriangles triangles; // triangles at the positions of the requested vertices
};

/// Returns one flag per vertex of `vertices`: 1 if it snaps to the same grid point as a requested vertex of `asked`.
std::vector<std::uint8_t> atPlacesOf(
    std::span<const VertexRequest> asked, const IndexedVertices& vertices, const hierarchy::Grid& grid) {
    const GridSnap snap(grid);
    std::vector<hierarchy::GridPoint> points;
    points.reserve(asked.size());
    IndexTable table(asked.size());
    const auto sameAs = [&](const hierarchy::GridPoint& p) {
        return [&](std::uint32_t other) { return points[other] == p; };
    };
    for (const VertexRequest& request : asked) {
        const hierarchy::GridPoint p = snap(vertices[vertices.find(request.vertex)].position);
        const auto next = static_cast<std::uint32_t>(points.size());
        if (table.findOrInsert(hashOf(p.x, p.y, p.z), next, sameAs(p)) == next) points.push_back(p);
    }
    std::vector<std::uint8_t> isThere(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const hierarchy::GridPoint p = snap(vertices[v].position);
        isThere[v] = table.find(hashOf(p.x, p.y, p.z), sameAs(p)) != IndexTable::kAbsent ? 1 : 0;
    }
    return isThere;
}

/// Returns the vertices of `vertices` whose flag in `isChosen` is nonzero. Changes the corners of `triangles` to the
/// new vertex indices. Each corner must be a chosen vertex.
IndexedVertices chosen(IndexedVertices vertices, const std::vector<std::uint8_t>& isChosen, ChunkTriangles& triangles) {
    std::size_t ownCount = vertices.ownCount();
    std::vector<ChunkVertex> some = std::move(vertices).take();
    std::vector<std::uint32_t> number(some.size(), hierarchy::kNone);
    std::uint32_t next = 0;
    for (std::size_t v = 0, own = ownCount; v < some.size(); ++v) {
        if (isChosen[v] == 0) {
            if (v < own) --ownCount;
            continue;
        }
        number[v] = next;
        some[next++] = some[v];
    }
    some.resize(next);
    for (std::vector<simplify::Triangle>* chosen : {&triangles.own, &triangles.ghosts})
        for (simplify::Triangle& t : *chosen)
            for (std::uint32_t& corner : t)
                corner = number[corner];
    return {std::move(some), ownCount};
}

Surroundings surroundingsOf(
    const BinnedSource& source,
    const scratch::StreamStore& borders,
    std::uint32_t chunk,
    std::span<const VertexRequest> asked,
    Progress& progress) {
    IndexedVertices all = readVertices(source, borders, chunk);
    std::vector<std::uint8_t> isNeeded(all.size(), 0);
    for (const VertexRequest& request : asked)
        isNeeded[all.find(request.vertex)] = 1;
    ChunkTriangles triangles = readTriangles(source, chunk, all, progress);
    const std::vector<std::uint8_t> isThere = atPlacesOf(asked, all, source.grid);
    for (std::vector<simplify::Triangle>* some : {&triangles.own, &triangles.ghosts}) {
        std::erase_if(
            *some, [&](const simplify::Triangle& t) { return (isThere[t[0]] | isThere[t[1]] | isThere[t[2]]) == 0; });
        for (const simplify::Triangle& t : *some)
            for (const std::uint32_t corner : t)
                isNeeded[corner] = 1;
    }
    IndexedVertices needed = chosen(std::move(all), isNeeded, triangles);
    isNeeded = {};
    return {ChunkVertices(std::move(needed), source.grid), std::move(triangles)};
}

/// Returns one normal per place (welded position) of `around`. Only the normals at requested vertices are correct.
std::vector<std::uint32_t> normalsOf(const Surroundings& around) {
    DroppedTriangles ignored;
    return levels::smoothNormals(
        around.vertices.places(),
        facesForNormals(
            around.vertices,
            keptTriangles(around.vertices, around.triangles.own, ignored),
            keptTriangles(around.vertices, around.triangles.ghosts, ignored)));
}

} // namespace

Messages answerVertices(const BinnedSource& source, std::uint32_t chunk) {
    auto requests = readRequests(source.bins, streamOf(BinStream::Requests, chunk), source.format);
    for (VertexRequest& request : requests)
        request.isOwner = 0;
    std::sort(requests.begin(), requests.end());
    requests.erase(std::unique(requests.begin(), requests.end()), requests.end());
    std::vector<ChunkVertex> vertices;
    appendVertices(source.bins, streamOf(BinStream::Vertices, chunk), source.format, vertices);
    Messages messages;
    VertexBytes storage{};
    for (const VertexRequest& request : requests) {
        const auto found = std::lower_bound(
            vertices.begin(), vertices.end(), request.vertex, [](const ChunkVertex& vertex, std::uint64_t index) {
                return vertex.index < index;
            });
        GNOMON_CHECK(found != vertices.end() && found->index == request.vertex);
        const auto record = encodeVertex(*found, source.format, storage);
        std::vector<std::byte>& bytes = messageTo(messages, request.chunk);
        bytes.insert(bytes.end(), record.begin(), record.end());
    }
    return messages;
}

Messages answerNormals(
    const BinnedSource& source, const scratch::StreamStore& borders, std::uint32_t chunk, Progress& progress) {
    auto requests = readRequests(source.bins, streamOf(BinStream::Requests, chunk), source.format);
    std::erase_if(requests, [](const VertexRequest& request) { return request.isOwner == 0; });
    std::sort(requests.begin(), requests.end());
    requests.erase(std::unique(requests.begin(), requests.end()), requests.end());
    Messages messages;
    if (requests.empty()) return messages;
    const Surroundings around = surroundingsOf(source, borders, chunk, requests, progress);
    const std::vector<std::uint32_t> normals = normalsOf(around);
    for (const VertexRequest& request : requests) {
        const SharedNormal answer{request.vertex, normals[around.vertices.placeOfSource(request.vertex)]};
        appendNormal(messageTo(messages, request.chunk), answer, source.format);
    }
    return messages;
}

} // namespace gnomon::chunk
