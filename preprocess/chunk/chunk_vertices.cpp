#include "preprocess/chunk/chunk_vertices.h"

#include "core/index_table.h"
#include "preprocess/chunk/survey.h"

#include <algorithm>
#include <array>

namespace gnomon::chunk {

namespace {

// The number of hash keys that are prefetched together, because the hash table is larger than the caches.
constexpr std::size_t kBatch = 16;

simplify::Triangle sorted(simplify::Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

bool isDegenerate(const ChunkVertices& vertices, const simplify::Triangle& t) {
    const auto same = [&](std::uint32_t a, std::uint32_t b) {
        return a == b || vertices[a].position == vertices[b].position;
    };
    return same(t[0], t[1]) || same(t[1], t[2]) || same(t[2], t[0]);
}

} // namespace

ChunkVertices::ChunkVertices(IndexedVertices vertices, const hierarchy::Grid& grid)
    : vertices_(std::move(vertices)), placeOf_(vertices_.size()) {
    const GridSnap snap(grid);
    places_.reserve(vertices_.size());
    IndexTable byPlace(vertices_.size());
    std::array<hierarchy::GridPoint, kBatch> points;
    std::array<std::uint64_t, kBatch> hashes{};
    for (std::size_t first = 0; first < vertices_.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, vertices_.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const hierarchy::GridPoint& p = points[i] = snap(vertices_[static_cast<std::uint32_t>(first + i)].position);
            hashes[i] = hashOf(p.x, p.y, p.z);
            byPlace.prefetch(hashes[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t v = first + i;
            const auto next = static_cast<std::uint32_t>(places_.size());
            placeOf_[v] =
                byPlace.findOrInsert(hashes[i], next, [&](std::uint32_t other) { return places_[other] == points[i]; });
            if (placeOf_[v] == next) places_.push_back(points[i]);
            if (v < vertices_.ownCount()) ownPlaces_ = static_cast<std::uint32_t>(places_.size());
        }
    }
}

std::vector<simplify::Triangle> keptTriangles(
    const ChunkVertices& vertices, const std::vector<simplify::Triangle>& triangles, DroppedTriangles& dropped) {
    std::vector<simplify::Triangle> kept;
    kept.reserve(triangles.size());
    IndexTable table(triangles.size());
    std::array<simplify::Triangle, kBatch> places{};
    std::array<std::uint64_t, kBatch> hashes{};
    for (std::size_t first = 0; first < triangles.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, triangles.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const simplify::Triangle& p = places[i] = sorted(vertices.placesOf(triangles[first + i]));
            hashes[i] = hashOf(p[0], p[1], p[2]);
            table.prefetch(hashes[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const simplify::Triangle& t = triangles[first + i];
            const simplify::Triangle& p = places[i];
            if (p[0] == p[1] || p[1] == p[2]) {
                ++(isDegenerate(vertices, t) ? dropped.degenerate : dropped.collapsedByGrid);
                continue;
            }
            const auto next = static_cast<std::uint32_t>(kept.size());
            const std::uint32_t found = table.findOrInsert(
                hashes[i], next, [&](std::uint32_t other) { return sorted(vertices.placesOf(kept[other])) == p; });
            if (found == next)
                kept.push_back(t);
            else
                ++dropped.doubled;
        }
    }
    return kept;
}

std::vector<std::uint8_t> sharedPlaces(const ChunkVertices& vertices, std::span<const VertexRequest> requests) {
    std::vector<std::uint8_t> isShared(vertices.places().size(), 1);
    std::fill_n(isShared.begin(), vertices.ownPlaces(), std::uint8_t{0});
    for (const VertexRequest& request : requests)
        if (request.isOwner != 0) isShared[vertices.placeOfSource(request.vertex)] = 1;
    return isShared;
}

} // namespace gnomon::chunk
