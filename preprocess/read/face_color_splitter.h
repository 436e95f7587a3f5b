// Converts face colours to vertex colours. A vertex is duplicated for each different colour of its faces.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Converts a mesh with face colours to a mesh with vertex colours. It receives first all vertices and then all
/// coloured faces, and duplicates each vertex whose faces have different colours.
class FaceColorSplitter {
public:
    /// Creates an empty mesh. `fields` are the names of the scalar properties of its vertices. `path` is the file that
    /// errors name. `memoryLimit` is the max memory of the collected data.
    FaceColorSplitter(std::string path, Bytes memoryLimit, std::vector<std::string> fields)
        : path_(std::move(path)), memoryLimit_(memoryLimit) {
        mesh_.fieldNames = std::move(fields);
    }

    /// Adds the next vertices of the file. Throws Error if the collected data need more memory than the limit.
    void addVertices(const VertexBlock& block);

    /// Adds a face with the vertex indices `corners` and the colour `color` (RGBA8). Throws Error if the collected data
    /// need more memory than the limit.
    void addFace(std::span<const std::uint64_t> corners, std::uint32_t color);

    /// Returns the mesh with vertex colours. Its vertices have the order of the file, and the copies of one vertex are
    /// sorted by colour. Vertices without a face are removed.
    MemoryMesh take();

private:
    void requireRoom() const;

    std::string path_;
    Bytes memoryLimit_;
    MemoryMesh mesh_; // each corner has the vertex index in its upper 32 bits and the colour in its lower 32 bits
};

/// Returns `mesh` with vertex colours, which replace its face colours `colors` (RGBA8, one per face). Throws Error,
/// which names `path`, if the conversion needs more memory than `memoryLimit`.
MemoryMesh withFaceColors(
    MemoryMesh mesh, std::span<const std::uint32_t> colors, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
