// A mesh in memory that the build can read like a file (as a MeshSource).
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <vector>

namespace gnomon::read {

/// A mesh of polygons, stored as plain arrays.
struct MemoryMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;       ///< empty, or one normal per vertex
    std::vector<std::uint32_t> colors;    ///< empty, or one colour per vertex (RGBA8, red in the lowest byte)
    std::vector<std::uint32_t> faceSizes; ///< number of corners per face
    std::vector<std::uint64_t> corners;   ///< vertex indices of all faces, one face after the other
    std::map<std::string, std::uint64_t> attributesDropped{}; ///< data of the file that were not read: name and count
    std::vector<std::string> fieldNames{};                    ///< names of the scalar vertex properties
    std::vector<double> fields{};                             ///< values of the scalar properties, vertex by vertex
    std::vector<std::string> remarks{};                       ///< notes for the user on how an ambiguous file was read
    /// Number of faces that the reader skipped, in addition to the faces with fewer than 3 corners in faceSizes.
    std::uint64_t notAPolygon = 0;
};

/// Returns the number of bytes that the array `values` has allocated.
template <class T>
std::uint64_t bytesOf(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

/// Throws Error if a file of `fileBytes` bytes could need more memory than `memoryLimit` when it is read completely.
void requireRoomForWhole(const std::string& path, std::uint64_t fileBytes, Bytes memoryLimit);

/// Returns a MeshSource that owns `mesh`. `path` is the file that errors name, and `fileBytes` is its size on disk.
/// Throws Error if the mesh has no faces.
std::unique_ptr<MeshSource> memorySource(const std::string& path, std::uint64_t fileBytes, MemoryMesh mesh);

} // namespace gnomon::read
