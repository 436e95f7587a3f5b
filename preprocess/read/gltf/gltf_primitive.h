// Reads the primitives of glTF meshes and converts them to triangles.
#pragma once

#include "preprocess/read/gltf/base_color.h"
#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::read {

/// The vertices and triangles of a glTF primitive, in the space of its mesh.
struct GltfPrimitive {
    std::vector<float> positions;      ///< three coordinates per vertex
    std::vector<float> normals;        ///< three components per vertex; empty if there are no normals
    std::vector<std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty if all are white
    std::vector<std::array<std::uint32_t, 3>> triangles;

    std::uint64_t vertexCount() const { return positions.size() / 3; }
};

/// Reads glTF primitives and stores decoded textures, because several primitives can use the same texture.
class GltfPrimitives {
public:
    /// Creates a reader of the primitives of `file`. If `bakesTextures` is true, textures are sampled at the vertices.
    /// Otherwise they are ignored.
    GltfPrimitives(GltfFile& file, bool bakesTextures) : file_(file), bakesTextures_(bakesTextures) {}

    /// Converts a glTF primitive (triangles, strips or fans) to triangles, in the order of glTF 2.0, section 3.7.2.1.
    /// Returns nullopt for points, lines and primitives without positions. Throws Error, which names the accessor, if
    /// an index is out of range or an attribute has the wrong number of elements.
    std::optional<GltfPrimitive> read(const tinygltf::Primitive& from);

    /// Returns the names of unused attributes and of unsupported primitive types, with the number of primitives that
    /// have them.
    const std::map<std::string, std::uint64_t>& rejected() const { return rejected_; }

    /// Returns the mean number of texels along a triangle edge, over all triangles whose texture was sampled at the
    /// vertices. The texture's detail between vertices is lost. Returns 0 if no texture was sampled.
    double texelsPerEdge() const { return edges_ > 0 ? texels_ / static_cast<double>(edges_) : 0; }

private:
    std::string addColors(const tinygltf::Primitive& from, GltfPrimitive& primitive);
    const BaseTexture* textureOf(const BaseColor& color, const tinygltf::Primitive& from);
    void countBadNormals(const std::vector<float>& normals);
    void countTexels(const GltfPrimitive& primitive, const std::vector<glm::dvec2>& places, const BaseTexture& texture);

    GltfFile& file_;
    bool bakesTextures_;
    std::map<int, std::optional<BaseTexture>> textures_;
    std::map<std::string, std::uint64_t> rejected_;
    double texels_ = 0;
    std::uint64_t edges_ = 0;
};

} // namespace gnomon::read
