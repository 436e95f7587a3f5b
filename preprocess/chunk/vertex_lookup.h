// Reads the positions of selected vertices of a source mesh in one pass. The memory is proportional to the number of
// selected vertices.
#pragma once

#include "core/check.h"
#include "preprocess/read/mesh_source.h"

#include <algorithm>
#include <span>
#include <vector>

namespace gnomon::chunk {

/// The positions of selected vertices of a source mesh. They can be found by the index of the vertex in the source.
class VertexLookup {
public:
    /// Reads the positions of `vertices` in one pass over the source. The list may be unsorted and contain repeats.
    VertexLookup(read::MeshSource& source, std::vector<std::uint64_t> vertices) : vertices_(std::move(vertices)) {
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        positions_.reserve(vertices_.size());
        source.readVertices([&](const read::VertexBlock& block) { take(block, vertices_, positions_); });
        GNOMON_CHECK_OP(positions_.size(), ==, vertices_.size());
    }

    /// Reads the positions of `vertices` from a source with indexed rows. The function does not read long gaps between
    /// the vertices.
    static VertexLookup byRanges(read::MeshSource& source, std::vector<std::uint64_t> vertices) {
        // Max number of skipped vertex rows that are read anyway. A gap of this length is about as long as one read of
        // the file.
        constexpr std::uint64_t kLittle = read::RowIndex::kRows;
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        std::vector<glm::dvec3> positions;
        positions.reserve(vertices.size());
        for (std::size_t begin = 0; begin < vertices.size(); begin = positions.size()) {
            std::size_t end = begin + 1;
            while (end < vertices.size() && vertices[end] - vertices[end - 1] < kLittle)
                ++end;
            source.readVertexRange(vertices[begin], vertices[end - 1] + 1, [&](const read::VertexBlock& block) {
                take(block, vertices, positions);
            });
            GNOMON_CHECK_OP(positions.size(), ==, end);
        }
        return {std::move(vertices), std::move(positions)};
    }

    /// Creates a lookup from vertex indices in ascending order and the positions of these vertices.
    VertexLookup(std::vector<std::uint64_t> vertices, std::vector<glm::dvec3> positions)
        : vertices_(std::move(vertices)), positions_(std::move(positions)) {
        GNOMON_CHECK_OP(positions_.size(), ==, vertices_.size());
    }

    const glm::dvec3& operator[](std::uint64_t vertex) const {
        const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
        return positions_[static_cast<std::size_t>(found - vertices_.begin())];
    }

    /// Returns the positions of the selected vertices, in ascending order of the vertex index.
    std::span<const glm::dvec3> positions() const { return positions_; }

    /// Appends the positions of those vertices in `vertices` (ascending) that come next and are in the block.
    static void take(
        const read::VertexBlock& block,
        const std::vector<std::uint64_t>& vertices,
        std::vector<glm::dvec3>& positions) {
        const std::uint64_t end = block.firstVertex + block.positions.size();
        while (positions.size() < vertices.size() && vertices[positions.size()] < end)
            positions.push_back(block.positions[vertices[positions.size()] - block.firstVertex]);
    }

private:
    std::vector<std::uint64_t> vertices_;
    std::vector<glm::dvec3> positions_;
};

} // namespace gnomon::chunk
