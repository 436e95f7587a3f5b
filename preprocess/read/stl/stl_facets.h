// Collects the facets of an STL: their corners become shared vertices.
#pragma once

#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::read {

class StlFacets {
public:
    /// Adds a facet. `normal` is compared with its corners, and counted if it says something else; a zero normal says
    /// nothing. Returns whether the facet has three different corners; others count as not a polygon.
    bool add(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal);

    MemoryMesh take() { return std::move(mesh_); }

private:
    std::uint64_t vertexAt(const glm::dvec3& given);
    void grow();

    MemoryMesh mesh_;
    std::vector<std::uint32_t>
        table_; ///< of vertices by the hash of their positions, one more than their index; 0: none
};

} // namespace gnomon::read
