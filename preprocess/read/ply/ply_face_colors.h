// PLY files whose faces have colours: a vertex is split where its faces have different ones.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"
#include "preprocess/read/ply/ply_rows.h"

#include <array>
#include <optional>

namespace gnomon::read {

/// The properties of a face that hold its red, green, blue and alpha; -1 for an alpha that is not there.
using FaceColorLayout = std::array<int, 4>;

/// Nothing where a face has no colour. (A face with `diffuse_red` and so on has none that anybody writes.)
std::optional<FaceColorLayout> faceColorLayoutOf(const PlyElement& element);

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

/// All rows of a face element; `list` is the property with the corners.
template <class Values>
void readColoredFaces(
    Values& values,
    const PlyElement& element,
    int list,
    const FaceColorLayout& layout,
    std::uint64_t vertexCount,
    FaceColorSplitter& out) {
    std::vector<std::uint64_t> corners;
    for (std::uint64_t row = 0; row < element.count; ++row) {
        std::uint32_t color = layout[3] < 0 ? 0xFF000000U : 0;
        for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
            const PlyProperty& property = element.properties[static_cast<std::size_t>(i)];
            const auto* const channel = std::find(layout.begin(), layout.end(), i);
            if (i == list)
                readCorners(values, property, vertexCount, corners);
            else if (channel != layout.end())
                color |= static_cast<std::uint32_t>(colorByte(property.type, values.real(property.type)))
                         << (8 * static_cast<std::uint32_t>(channel - layout.begin()));
            else
                skipProperty(values, property);
        }
        values.endRow();
        out.addFace(corners, color);
    }
}

} // namespace gnomon::read
