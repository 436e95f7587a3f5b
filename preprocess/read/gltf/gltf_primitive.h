// A primitive of a mesh of glTF as triangles.
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

/// In the space of its mesh.
struct GltfPrimitive {
    std::vector<float> positions;      ///< three a vertex
    std::vector<float> normals;        ///< the same; empty if it has none
    std::vector<std::uint32_t> colors; ///< RGBA8, red in the lowest byte; empty where it is white
    std::vector<std::array<std::uint32_t, 3>> triangles;

    std::uint64_t vertexCount() const { return positions.size() / 3; }
};

/// Reads primitives; keeps the images that several of them show.
class GltfPrimitives {
public:
    /// Textures are looked up at vertices if `bakesTextures`, else they are left out.
    GltfPrimitives(GltfFile& file, bool bakesTextures) : file_(file), bakesTextures_(bakesTextures) {}

    /// Triangles, strips and fans, in the order of glTF 2.0, section 3.7.2.1; nothing for points and lines. Throws
    /// Error that names the accessor for indices out of range and attributes of another length.
    std::optional<GltfPrimitive> read(const tinygltf::Primitive& from);

    /// The attributes and primitives that no model uses, and how many primitives have them.
    const std::map<std::string, std::uint64_t>& leftOut() const { return leftOut_; }

    /// Texels along an edge of a triangle, where textures were looked up at vertices, in the mean of all such edges;
    /// what lies between is lost. 0 where none was.
    double texelsPerEdge() const { return edges_ > 0 ? texels_ / static_cast<double>(edges_) : 0; }

private:
    std::string addColors(const tinygltf::Primitive& from, GltfPrimitive& primitive);
    const BaseTexture* textureOf(const BaseColor& color, const tinygltf::Primitive& from);
    void countBadNormals(const std::vector<float>& normals);
    void countTexels(const GltfPrimitive& primitive, const std::vector<glm::dvec2>& places, const BaseTexture& texture);

    GltfFile& file_;
    bool bakesTextures_;
    std::map<int, std::optional<BaseTexture>> textures_;
    std::map<std::string, std::uint64_t> leftOut_;
    double texels_ = 0;
    std::uint64_t edges_ = 0;
};

} // namespace gnomon::read
