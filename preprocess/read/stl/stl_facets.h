// Converts the triangles of an STL file to an indexed mesh. Corners at equal positions become one vertex.
#pragma once

#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::read {

/// Collects the triangles of an STL file as an indexed mesh.
class StlFacets {
public:
    /// Adds a triangle. Returns true if its three corners are at different positions. Other triangles are only counted.
    /// The function also counts triangles whose `normal` differs by more than about 8 degrees from the normal of their
    /// corners. A zero `normal` is ignored.
    bool add(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal);

    MemoryMesh take() { return std::move(mesh_); }

private:
    std::uint64_t vertexAt(const glm::dvec3& given);
    void grow();

    MemoryMesh mesh_;
    std::vector<std::uint32_t> table_; ///< hash table of positions: vertex index + 1, or 0 for an empty entry
};

} // namespace gnomon::read
