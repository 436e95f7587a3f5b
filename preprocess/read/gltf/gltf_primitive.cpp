#include "preprocess/read/gltf/gltf_primitive.h"

#include "core/error.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/mesh_source.h"

#include <cmath>
#include <numeric>

namespace gnomon::read {

namespace {

/// Returns the index of the accessor for the vertex attribute `name`, or -1 if the primitive has no such attribute.
int attributeOf(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

void requireAsMany(const GltfFile& file, int accessor, std::uint64_t vertices) {
    const std::uint64_t count = countOf(file, accessor);
    if (count != vertices)
        throw Error(
            file.where("accessor", static_cast<std::uint64_t>(accessor)),
            "wrong number of values",
            std::to_string(vertices) + " values",
            std::to_string(count));
}

/// Returns the triangles of a glTF primitive with the vertex indices `corners`. `mode` says whether they are a list of
/// triangles, a strip or a fan.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(
    GltfFile& file, int mode, const std::vector<std::uint32_t>& corners, const std::string& where) {
    const std::size_t count = corners.size();
    if (mode == TINYGLTF_MODE_TRIANGLES && count % 3 != 0)
        throw Error(
            where, "the last triangle is incomplete", "a multiple of three", std::to_string(count) + " corners");
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const std::size_t stride = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    file.room().take(count / stride, sizeof(triangles[0]));
    triangles.reserve(count / stride);
    for (std::size_t i = 0; i + 2 < count; i += stride) {
        const std::size_t odd = i % 2;
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.push_back({corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
        else if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
        else
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return triangles;
}

} // namespace

std::optional<GltfPrimitive> GltfPrimitives::read(const tinygltf::Primitive& from) {
    const int mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        ++rejected_[mode == TINYGLTF_MODE_POINTS ? "primitives of points" : "primitives of lines"];
        return std::nullopt;
    }
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
        throw Error(file_.path(), "unknown mode of a primitive", "0 to 6", std::to_string(mode));
    const int positions = attributeOf(from, "POSITION");
    if (positions < 0) {
        ++rejected_["primitives without positions"];
        return std::nullopt;
    }
    GltfPrimitive primitive;
    primitive.positions = numbersOf(file_, positions, 3);
    const std::uint64_t vertices = primitive.vertexCount();
    std::vector<std::uint32_t> corners;
    if (from.indices >= 0) {
        corners = indicesOf(file_, from.indices);
    } else {
        file_.room().take(vertices, sizeof(corners[0]));
        corners.resize(vertices);
        std::iota(corners.begin(), corners.end(), 0U);
    }
    const std::string where =
        file_.where("accessor", static_cast<std::uint64_t>(from.indices >= 0 ? from.indices : positions));
    for (const std::uint32_t corner : corners)
        if (corner >= vertices)
            throw Error(where, "index out of range", "below " + std::to_string(vertices), std::to_string(corner));
    primitive.triangles = trianglesOf(file_, mode, corners, where);
    file_.room().give(corners.size() * sizeof(corners[0]));
    if (const int normals = attributeOf(from, "NORMAL"); normals >= 0) {
        requireAsMany(file_, normals, vertices);
        primitive.normals = numbersOf(file_, normals, 3);
        countBadNormals(primitive.normals);
    }
    if (!from.targets.empty()) ++rejected_["morph targets"];
    const std::string coordinates = addColors(from, primitive);
    for (const auto& [name, accessor] : from.attributes)
        if (name != "POSITION" && name != "NORMAL" && name != "COLOR_0" && name != coordinates) ++rejected_[name];
    return primitive;
}

void GltfPrimitives::countBadNormals(const std::vector<float>& normals) {
    for (std::size_t i = 0; i < normals.size(); i += 3)
        if (!std::isfinite(double{normals[i]} + normals[i + 1] + normals[i + 2])) ++rejected_[kBadNormals];
}

/// Returns the texture that `color` uses. Returns null if textures are ignored, or if the texture coordinates or the
/// image are missing. The texture then counts as not used.
const BaseTexture* GltfPrimitives::textureOf(const BaseColor& color, const tinygltf::Primitive& from) {
    if (color.texture < 0) return nullptr;
    if (!bakesTextures_) {
        ++rejected_["textures"];
        return nullptr;
    }
    if (attributeOf(from, "TEXCOORD_" + std::to_string(color.texCoord)) < 0) {
        ++rejected_["textures without coordinates"];
        return nullptr;
    }
    auto found = textures_.find(color.texture);
    if (found == textures_.end()) found = textures_.emplace(color.texture, baseTextureOf(file_, color.texture)).first;
    if (!found->second) ++rejected_["textures whose image is not there"];
    return found->second ? &*found->second : nullptr;
}

/// Sets the vertex colours of `primitive` from its material, its vertex attributes and its texture. Returns the name of
/// the attribute with the texture coordinates. Returns an empty name if no texture was sampled.
std::string GltfPrimitives::addColors(const tinygltf::Primitive& from, GltfPrimitive& primitive) {
    const BaseColor color = baseColorOf(file_, from.material);
    const BaseTexture* const texture = textureOf(color, from);
    const std::uint64_t vertices = primitive.vertexCount();
    const int ofVertices = attributeOf(from, "COLOR_0");
    if (texture == nullptr && ofVertices < 0 && color.factor == glm::dvec4(1)) return {};
    std::vector<float> tints;
    std::vector<float> coordinates;
    std::string attribute = texture == nullptr ? "" : "TEXCOORD_" + std::to_string(color.texCoord);
    if (ofVertices >= 0) {
        requireAsMany(file_, ofVertices, vertices);
        tints = colorsOf(file_, ofVertices);
    }
    if (texture != nullptr) {
        const int accessor = attributeOf(from, attribute);
        requireAsMany(file_, accessor, vertices);
        coordinates = numbersOf(file_, accessor, 2);
    }
    file_.room().take(vertices, sizeof(primitive.colors[0]));
    primitive.colors.resize(vertices);
    std::vector<glm::dvec2> places(coordinates.size() / 2);
    std::uint64_t clear = color.isClear ? vertices : 0;
    for (std::size_t i = 0; i < vertices; ++i) {
        glm::dvec4 value = color.factor;
        if (!tints.empty()) value *= glm::dvec4(tints[4 * i], tints[4 * i + 1], tints[4 * i + 2], tints[4 * i + 3]);
        if (texture != nullptr) {
            places[i] = color.toImage * glm::dvec3(coordinates[2 * i], coordinates[2 * i + 1], 1);
            value *= texture->at(places[i]);
        }
        if (!color.isClear) {
            clear += tints.empty() || tints[4 * i + 3] >= 1 ? 0 : 1;
            value.a = 1;
        }
        primitive.colors[i] = packedColor(value);
    }
    if (clear > 0) rejected_["alpha"] += clear;
    file_.room().give((tints.size() + coordinates.size()) * sizeof(float));
    if (texture != nullptr) countTexels(primitive, places, *texture);
    return attribute;
}

void GltfPrimitives::countTexels(
    const GltfPrimitive& primitive, const std::vector<glm::dvec2>& places, const BaseTexture& texture) {
    const glm::dvec2 size(texture.image.width, texture.image.height);
    for (const auto& triangle : primitive.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = glm::length((places[triangle[(k + 1) % 3]] - places[triangle[k]]) * size);
            if (!(length < 1e9)) continue;
            texels_ += length;
            ++edges_;
        }
}

} // namespace gnomon::read
