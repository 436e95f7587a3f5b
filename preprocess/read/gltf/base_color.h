// The base colour of a glTF material, with its texture.
#pragma once

#include "preprocess/read/gltf/decoded_image.h"
#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::read {

/// The base colour of a material in linear light: a factor, which is multiplied by a texture if there is one.
struct BaseColor {
    glm::dvec4 factor{1};
    int texture = -1;                       ///< index in the model; -1 for none
    int texCoord = 0;                       ///< index of the set of texture coordinates
    bool isClear = false;                   ///< the material uses alpha; else alpha is 1
    glm::dmat3x2 toImage{1, 0, 0, 1, 0, 0}; ///< from (u, v, 1) to texture coordinates, by KHR_texture_transform
};

/// Returns the base colour of material `material`; white for -1. If the material has
/// KHR_materials_pbrSpecularGlossiness, returns the diffuse colour of this extension instead. Throws Error if there is
/// no such material.
BaseColor baseColorOf(const GltfFile& file, int material);

/// A decoded texture with its wrap modes.
struct BaseTexture {
    DecodedImage image;
    std::array<int, 2> wraps{TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_REPEAT}; ///< along u and v

    /// Returns the bilinear sample at (u, v) in linear light: red, green, blue and alpha. u points to the right and v
    /// downwards.
    glm::dvec4 at(glm::dvec2 uv) const;
};

/// Returns texture `texture`. Returns nothing if its image is missing, or if only an extension that is not read
/// provides it.
std::optional<BaseTexture> baseTextureOf(GltfFile& file, int texture);

/// Returns the linear colour as RGBA8 with red in the lowest byte. Clamps to 0 to 1 and applies the sRGB curve (IEC
/// 61966-2-1) to red, green and blue.
std::uint32_t packedColor(const glm::dvec4& linear);

} // namespace gnomon::read
