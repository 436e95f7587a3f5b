// Converts the facets of an STL to an indexed mesh: corners at equal positions become one vertex.
#pragma once

#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::read {

/// Collects the facets of an STL as an indexed mesh.
class StlFacets {
public:
    /// Adds a facet. Returns whether it has three different corners; other facets count as not a polygon. Counts the
    /// facet if `normal` differs by more than about 8 degrees from the normal of its corners. A zero `normal` is
    /// ignored.
    bool add(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal);

    MemoryMesh take() { return std::move(mesh_); }

private:
    std::uint64_t vertexAt(const glm::dvec3& given);
    void grow();

    MemoryMesh mesh_;
    std::vector<std::uint32_t> table_; ///< hash table by position: vertex index + 1, or 0 for empty
};

} // namespace gnomon::read
