// A mesh that is held in memory, as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <vector>

namespace gnomon::read {

/// Vertices and polygons as plain arrays.
struct MemoryMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;       ///< empty, or one a vertex
    std::vector<std::uint32_t> colors;    ///< empty, or one a vertex; RGBA8, red in the lowest byte
    std::vector<std::uint32_t> faceSizes; ///< corners of each face
    std::vector<std::uint64_t> corners;   ///< of all faces one after the other, each below positions.size()
    std::map<std::string, std::uint64_t> attributesDropped{}; ///< as in MeshSummary
    std::vector<std::string> fieldNames{};                    ///< as in MeshSummary
    std::vector<double> fields{};                             ///< of all vertices, as in VertexBlock
    std::vector<std::string> remarks{};                       ///< as in MeshSummary
    std::uint64_t notAPolygon = 0; ///< faces that never came this far, besides those of faceSizes below 3
};

/// Returns the bytes that an array takes.
template <class T>
std::uint64_t bytesOf(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

/// Throws Error if reading a file of `fileBytes` into memory could take more than `memoryLimit`.
void requireRoomForWhole(const std::string& path, std::uint64_t fileBytes, Bytes memoryLimit);

/// Takes the mesh over. `path` names it in errors, `fileBytes` is what it took on disk.
std::unique_ptr<MeshSource> memorySource(const std::string& path, std::uint64_t fileBytes, MemoryMesh mesh);

} // namespace gnomon::read
