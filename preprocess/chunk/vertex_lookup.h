// Fetching some vertices of a source by index in one pass, in the memory of what is fetched.
#pragma once

#include "core/check.h"
#include "preprocess/read/mesh_source.h"

#include <algorithm>
#include <vector>

namespace gnomon::chunk {

/// The positions of chosen vertices.
class VertexLookup {
public:
    /// Reads the positions of `vertices` (any order, repeats welcome) in one pass over the source.
    VertexLookup(read::MeshSource& source, std::vector<std::uint64_t> vertices) : vertices_(std::move(vertices)) {
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        positions_.reserve(vertices_.size());
        source.readVertices([&](const read::VertexBlock& block) {
            const std::uint64_t end = block.firstVertex + block.positions.size();
            while (positions_.size() < vertices_.size() && vertices_[positions_.size()] < end)
                positions_.push_back(block.positions[vertices_[positions_.size()] - block.firstVertex]);
        });
        GNOMON_CHECK_OP(positions_.size(), ==, vertices_.size());
    }

    /// Of `vertices`, ascending, with their positions.
    VertexLookup(std::vector<std::uint64_t> vertices, std::vector<glm::dvec3> positions)
        : vertices_(std::move(vertices)), positions_(std::move(positions)) {
        GNOMON_CHECK_OP(positions_.size(), ==, vertices_.size());
    }

    const glm::dvec3& operator[](std::uint64_t vertex) const {
        const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
        return positions_[static_cast<std::size_t>(found - vertices_.begin())];
    }

private:
    std::vector<std::uint64_t> vertices_;
    std::vector<glm::dvec3> positions_;
};

} // namespace gnomon::chunk
