// Converts face colours to vertex colours. A vertex is duplicated for each different colour of its faces.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects first the vertices and then the coloured faces of a file. It duplicates vertices whose faces have different
/// colours.
class FaceColorSplitter {
public:
    /// Creates an empty mesh whose vertices have one value per name in `fields`. Errors name `path`. `memoryLimit` is
    /// the max memory of the collected data.
    FaceColorSplitter(std::string path, Bytes memoryLimit, std::vector<std::string> fields)
        : path_(std::move(path)), memoryLimit_(memoryLimit) {
        mesh_.fieldNames = std::move(fields);
    }

    /// Adds vertices in index order. Throws Error if the collected data need more memory than the limit.
    void addVertices(const VertexBlock& block);

    /// Adds a face with the colour `color` (RGBA8). Throws Error if the collected data need more memory than the limit.
    void addFace(std::span<const std::uint64_t> corners, std::uint32_t color);

    /// Returns the mesh. Vertices are in the order of their index in the file, and copies of a vertex in the order of
    /// their colour. Vertices without a face are removed.
    MemoryMesh take();

private:
    void requireRoom() const;

    std::string path_;
    Bytes memoryLimit_;
    MemoryMesh mesh_; // a corner has the vertex index in its upper 32 bits and the colour in its lower 32 bits
};

/// Converts the face colours `colors` (RGBA8, one per face) to vertex colours, and returns `mesh` with them. Throws
/// Error, which names `path`, if this needs more memory than `memoryLimit`.
MemoryMesh withFaceColors(
    MemoryMesh mesh, std::span<const std::uint32_t> colors, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
