// The base colour of a glTF material: the colour of its surface in white light.
#pragma once

#include "preprocess/read/gltf/decoded_image.h"
#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::read {

/// Factors in linear light, and where they are to be multiplied by a texture.
struct BaseColor {
    glm::dvec4 factor{1};
    int texture = -1;                       ///< of the model; -1 for none
    int texCoord = 0;                       ///< the set of texture coordinates
    bool isClear = false;                   ///< alpha counts; else it is 1
    glm::dmat3x2 toImage{1, 0, 0, 1, 0, 0}; ///< from (u, v, 1), by KHR_texture_transform
};

/// Returns the base colour of material `material`; white for -1. KHR_materials_pbrSpecularGlossiness replaces the
/// colour of the material that has it. Throws Error if there is no such material.
BaseColor baseColorOf(const GltfFile& file, int material);

/// A texture that can be looked up.
struct BaseTexture {
    DecodedImage image;
    std::array<int, 2> wraps{TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_REPEAT}; ///< along u and v

    /// Red, green, blue and alpha in linear light at (u, v), u to the right and v downwards, between the four texels
    /// around it.
    glm::dvec4 at(glm::dvec2 uv) const;
};

/// Texture `texture`; nothing where its image is not there or of a format that is not read.
std::optional<BaseTexture> baseTextureOf(GltfFile& file, int texture);

/// RGBA8 with red in the lowest byte, colours by the sRGB curve (IEC 61966-2-1), of linear values, cut off at 0 and 1.
std::uint32_t packedColor(const glm::dvec4& linear);

} // namespace gnomon::read
