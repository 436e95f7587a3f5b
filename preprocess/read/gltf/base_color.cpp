#include "preprocess/read/gltf/base_color.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::read {

namespace {

/// Converts an sRGB value from 0 to 1 to linear light (IEC 61966-2-1). displayOf is the inverse function.
double linearOf(double display) {
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

double displayOf(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

const std::array<double, 256>& linearBytes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = linearOf(static_cast<double>(i) / 255);
        return values;
    }();
    return table;
}

/// Returns the index of the texel that an infinitely repeated texture has at position `at` along one axis. The texture
/// has `size` texels along this axis. `wrap` is the glTF wrap mode.
int wrapped(double at, int size, int wrap) {
    if (!(std::abs(at) < 1e9)) return 0;
    const auto texel = static_cast<std::int64_t>(at);
    if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE)
        return static_cast<int>(std::clamp<std::int64_t>(texel, 0, size - 1));
    const std::int64_t period = wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? std::int64_t{2} * size : size;
    const std::int64_t inPeriod = (texel % period + period) % period;
    return static_cast<int>(inPeriod < size ? inPeriod : period - 1 - inPeriod);
}

/// Returns the two numbers in the member `key` of a glTF extension. Returns `otherwise` if the member is missing.
glm::dvec2 pairOf(const tinygltf::Value& object, const char* key, glm::dvec2 otherwise) {
    if (!object.Has(key) || !object.Get(key).IsArray() || object.Get(key).ArrayLen() != 2) return otherwise;
    return {object.Get(key).Get(0).GetNumberAsDouble(), object.Get(key).Get(1).GetNumberAsDouble()};
}

/// Returns the non-negative integer in the member `key` of a glTF extension. Returns `otherwise` if the member is
/// missing.
int indexMember(const tinygltf::Value& object, const char* key, int otherwise) {
    if (!object.Has(key) || !object.Get(key).IsNumber()) return otherwise;
    const double value = object.Get(key).GetNumberAsDouble();
    return value >= 0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : otherwise;
}

/// Applies the glTF extension KHR_texture_transform to the texture coordinates of `color`. They are scaled, then
/// rotated, then translated. If the extension names a set of texture coordinates, this set replaces the texture's own
/// set.
void applyTransform(const tinygltf::Value& transform, BaseColor& color) {
    if (!transform.IsObject()) return;
    const glm::dvec2 offset = pairOf(transform, "offset", {0, 0});
    const glm::dvec2 scale = pairOf(transform, "scale", {1, 1});
    const bool isTurned = transform.Has("rotation") && transform.Get("rotation").IsNumber();
    const double turn = isTurned ? transform.Get("rotation").GetNumberAsDouble() : 0;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    color.toImage = {scale.x * c, -scale.x * s, scale.y * s, scale.y * c, offset.x, offset.y};
    color.texCoord = indexMember(transform, "texCoord", color.texCoord);
}

constexpr const char* kTextureTransform = "KHR_texture_transform";

/// Sets `color` to the diffuse colour of the glTF extension KHR_materials_pbrSpecularGlossiness.
void takeDiffuse(const tinygltf::Value& surface, BaseColor& color) {
    if (!surface.IsObject()) return;
    const tinygltf::Value& factor = surface.Get("diffuseFactor");
    if (factor.IsArray() && factor.ArrayLen() == 4)
        for (int i = 0; i < 4; ++i)
            color.factor[i] = factor.Get(i).GetNumberAsDouble();
    const tinygltf::Value& texture = surface.Get("diffuseTexture");
    if (!texture.IsObject()) return;
    color.texture = indexMember(texture, "index", -1);
    color.texCoord = indexMember(texture, "texCoord", 0);
    const tinygltf::Value& extensions = texture.Get("extensions");
    if (extensions.IsObject()) applyTransform(extensions.Get(kTextureTransform), color);
}

} // namespace

BaseColor baseColorOf(const GltfFile& file, int material) {
    BaseColor color;
    if (material < 0) return color;
    const tinygltf::Material& from = file.elementOf(file.model().materials, material, "material");
    color.isClear = from.alphaMode != "OPAQUE";
    if (const auto specular = from.extensions.find("KHR_materials_pbrSpecularGlossiness");
        specular != from.extensions.end()) {
        takeDiffuse(specular->second, color);
        return color;
    }
    const tinygltf::PbrMetallicRoughness& surface = from.pbrMetallicRoughness;
    for (std::size_t i = 0; i < 4 && i < surface.baseColorFactor.size(); ++i)
        color.factor[static_cast<int>(i)] = surface.baseColorFactor[i];
    color.texture = surface.baseColorTexture.index;
    color.texCoord = surface.baseColorTexture.texCoord;
    if (const auto transform = surface.baseColorTexture.extensions.find(kTextureTransform);
        transform != surface.baseColorTexture.extensions.end())
        applyTransform(transform->second, color);
    return color;
}

std::optional<BaseTexture> baseTextureOf(GltfFile& file, int texture) {
    const tinygltf::Texture& from = file.elementOf(file.model().textures, texture, "texture");
    if (from.source < 0) return std::nullopt; // no source means that only an extension provides the image
    const std::vector<std::byte> encoded = file.image(from.source);
    if (encoded.empty()) return std::nullopt;
    BaseTexture result;
    result.image = decodedImage(encoded, file.room(), file.where("image", static_cast<std::uint64_t>(from.source)));
    if (from.sampler >= 0 && from.sampler < static_cast<int>(file.model().samplers.size())) {
        const tinygltf::Sampler& sampler = file.model().samplers[static_cast<std::size_t>(from.sampler)];
        result.wraps = {sampler.wrapS, sampler.wrapT};
    }
    return result;
}

glm::dvec4 BaseTexture::at(glm::dvec2 uv) const {
    const glm::dvec2 place = uv * glm::dvec2(image.width, image.height) - 0.5;
    const glm::dvec2 low = glm::floor(place);
    const glm::dvec2 part = place - low;
    glm::dvec4 sum(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int x = wrapped(low.x + i, image.width, wraps[0]);
            const int y = wrapped(low.y + j, image.height, wraps[1]);
            const std::size_t texel =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 4;
            const double share = (i == 0 ? 1 - part.x : part.x) * (j == 0 ? 1 - part.y : part.y);
            const auto& linear = linearBytes();
            sum += share * glm::dvec4(
                               linear[image.pixels[texel]],
                               linear[image.pixels[texel + 1]],
                               linear[image.pixels[texel + 2]],
                               image.pixels[texel + 3] / 255.0);
        }
    return sum;
}

std::uint32_t packedColor(const glm::dvec4& linear) {
    std::uint32_t packed = 0;
    for (int i = 3; i >= 0; --i) {
        const double value = linear[i] > 0 ? std::min(linear[i], 1.0) : 0; // NaN becomes 0
        packed = packed << 8U | static_cast<std::uint32_t>(std::lround(255 * (i < 3 ? displayOf(value) : value)));
    }
    return packed;
}

} // namespace gnomon::read
