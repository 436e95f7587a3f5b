// A mesh in memory that can be read as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <vector>

namespace gnomon::read {

/// A mesh of polygons, stored as plain arrays.
struct MemoryMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;       ///< empty, or one per vertex
    std::vector<std::uint32_t> colors;    ///< empty, or one per vertex; RGBA8, red in the lowest byte
    std::vector<std::uint32_t> faceSizes; ///< number of corners per face
    std::vector<std::uint64_t> corners;   ///< vertex indices of all faces, one face after the other
    std::map<std::string, std::uint64_t> attributesDropped{}; ///< as in MeshSummary
    std::vector<std::string> fieldNames{};                    ///< as in MeshSummary
    std::vector<double> fields{};                             ///< values of all vertices, as in VertexBlock
    std::vector<std::string> remarks{};                       ///< as in MeshSummary
    /// Number of faces that the reader skipped. Faces with fewer than 3 corners in faceSizes are counted separately.
    std::uint64_t notAPolygon = 0;
};

/// Returns the allocated memory of an array in bytes.
template <class T>
std::uint64_t bytesOf(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

/// Throws Error if reading a file of `fileBytes` bytes into memory could need more memory than `memoryLimit`.
void requireRoomForWhole(const std::string& path, std::uint64_t fileBytes, Bytes memoryLimit);

/// Returns a source that owns `mesh`. `path` names the source in errors, and `fileBytes` is its size on disk. Throws
/// Error if the mesh has no faces.
std::unique_ptr<MeshSource> memorySource(const std::string& path, std::uint64_t fileBytes, MemoryMesh mesh);

} // namespace gnomon::read
