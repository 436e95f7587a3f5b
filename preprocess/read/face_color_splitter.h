// Faces with colours: a vertex is split where its faces have different ones.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects the vertices of a file and then its coloured faces, and splits the one by the other.
class FaceColorSplitter {
public:
    /// `path` and `memoryLimit` for what is refused; the vertices come with values for `fields`.
    FaceColorSplitter(std::string path, Bytes memoryLimit, std::vector<std::string> fields)
        : path_(std::move(path)), memoryLimit_(memoryLimit) {
        mesh_.fieldNames = std::move(fields);
    }

    void addVertices(const VertexBlock& block);

    /// A face of such vertices. Throws Error where what is held by now takes more than the limit.
    void addFace(std::span<const std::uint64_t> corners, std::uint32_t color);

    /// The mesh: vertices in their order, those of one by the colours that its faces have. Vertices of no face are
    /// left out.
    MemoryMesh take();

private:
    void requireRoom() const;

    std::string path_;
    Bytes memoryLimit_;
    MemoryMesh mesh_; // its corners name a vertex in the upper and a colour in the lower half
};

/// Returns `mesh` with the colours of its faces, RGBA8, one per face. `path` and `memoryLimit` as above.
MemoryMesh withFaceColors(
    MemoryMesh mesh, std::span<const std::uint32_t> colors, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
