#include "preprocess/read/stl/stl_facets.h"

#include "core/error.h"

#include <bit>

namespace gnomon::read {

namespace {

std::uint64_t hashOf(const glm::dvec3& position) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        hash ^= std::bit_cast<std::uint64_t>(position[axis]);
        hash *= 0x9E3779B97F4A7C15U;
        hash ^= hash >> 32U;
    }
    return hash;
}

/// Returns true if `normal` differs from the normal of the triangle `corners` by more than about 8 degrees.
bool isOtherNormal(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal) {
    const glm::dvec3 own = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double lengths = glm::dot(own, own) * glm::dot(normal, normal);
    const double along = glm::dot(own, normal);
    constexpr double kSquaredCosine = 0.98;
    return lengths > 0 && !(along > 0 && along * along >= kSquaredCosine * lengths);
}

} // namespace

/// Doubles the size of the hash table of positions if the next position would fill it by more than half.
void StlFacets::grow() {
    if (2 * (mesh_.positions.size() + 1) <= table_.size()) return;
    table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), 0);
    for (std::size_t vertex = 0; vertex < mesh_.positions.size(); ++vertex) {
        std::size_t place = hashOf(mesh_.positions[vertex]) & (table_.size() - 1);
        while (table_[place] != 0)
            place = (place + 1) & (table_.size() - 1);
        table_[place] = static_cast<std::uint32_t>(vertex + 1);
    }
}

std::uint64_t StlFacets::vertexAt(const glm::dvec3& given) {
    const glm::dvec3 position = given + 0.0; // adding 0 converts -0 to +0
    grow();
    std::size_t place = hashOf(position) & (table_.size() - 1);
    while (table_[place] != 0) {
        if (mesh_.positions[table_[place] - 1] == position) return table_[place] - 1;
        place = (place + 1) & (table_.size() - 1);
    }
    mesh_.positions.push_back(position);
    table_[place] = static_cast<std::uint32_t>(mesh_.positions.size());
    return mesh_.positions.size() - 1;
}

bool StlFacets::add(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal) {
    std::array<std::uint64_t, 3> vertices{};
    for (std::size_t i = 0; i < corners.size(); ++i)
        vertices[i] = vertexAt(corners[i]);
    if (isOtherNormal(corners, normal)) ++mesh_.attributesDropped["normals unlike those of their facets"];
    if (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]) {
        ++mesh_.notAPolygon;
        return false;
    }
    mesh_.corners.insert(mesh_.corners.end(), vertices.begin(), vertices.end());
    mesh_.faceSizes.push_back(3);
    return true;
}

} // namespace gnomon::read
