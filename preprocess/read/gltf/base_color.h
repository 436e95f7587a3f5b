// Reads the base colour of a glTF material and its texture.
#pragma once

#include "preprocess/read/gltf/decoded_image.h"
#include "preprocess/read/gltf/gltf_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::read {

/// The base colour of a glTF material in linear light. It is a factor, multiplied by the texture if there is one.
struct BaseColor {
    glm::dvec4 factor{1};
    int texture = -1;                       ///< index of the texture in the glTF file; -1 for none
    int texCoord = 0;                       ///< index of the set of texture coordinates
    bool isClear = false;                   ///< whether the material uses alpha; otherwise alpha is 1
    glm::dmat3x2 toImage{1, 0, 0, 1, 0, 0}; ///< from (u, v, 1) to texture coordinates (KHR_texture_transform)
};

/// Returns the base colour of the glTF material with the index `material`. Returns white for the index -1. If the
/// material has the extension KHR_materials_pbrSpecularGlossiness, returns the diffuse colour of this extension
/// instead. Throws Error if the material does not exist.
BaseColor baseColorOf(const GltfFile& file, int material);

/// A decoded texture with its wrap modes.
struct BaseTexture {
    DecodedImage image;
    std::array<int, 2> wraps{TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_REPEAT}; ///< wrap modes along u and v

    /// Returns the bilinearly filtered texture at the coordinates `uv`: red, green, blue and alpha in linear light. u
    /// points to the right and v downwards.
    glm::dvec4 at(glm::dvec2 uv) const;
};

/// Returns the decoded texture with the index `texture`. Returns nullopt if its image is missing, or if only an
/// unsupported extension provides the image.
std::optional<BaseTexture> baseTextureOf(GltfFile& file, int texture);

/// Converts a colour in linear light to sRGB with 8 bits per channel (RGBA8), red in the lowest byte. Clamps channels
/// to 0 and 1 and applies the sRGB curve (IEC 61966-2-1) to red, green and blue.
std::uint32_t packedColor(const glm::dvec4& linear);

} // namespace gnomon::read
