#include "preprocess/read/gltf/gltf_document.h"

#include "core/limit_error.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace gnomon::read {

namespace {

using nlohmann::json;

/// The glTF extensions that Gnomon supports.
constexpr std::array<std::string_view, 5> kReadExtensions = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_mesh_quantization",
    "KHR_texture_transform"};

/// Harmless glTF extensions: Gnomon does not support them, but they change neither the surface nor its base colour. A
/// file that requires them can therefore be read.
constexpr std::array<std::string_view, 22> kHarmlessExtensions = {
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "KHR_animation_pointer",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_xmp",
    "KHR_xmp_json_ld"};

/// Extensions of glTF for textures in unsupported formats. They cause an error only if textures are read.
constexpr std::array<std::string_view, 6> kTextureExtensions = {
    "EXT_texture_avif",
    "EXT_texture_webp",
    "GOOGLE_texture_basis",
    "KHR_texture_basisu",
    "MPEG_texture_video",
    "MSFT_texture_dds"};

constexpr std::array<std::string_view, 17> kUsedLists = {
    "accessors",
    "asset",
    "bufferViews",
    "buffers",
    "cameras",
    "extensions",
    "extensionsRequired",
    "extensionsUsed",
    "extras",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scene",
    "scenes",
    "textures"};

constexpr std::array<std::string_view, 7> kUsedOfMaterial = {
    "alphaCutoff", "alphaMode", "doubleSided", "extensions", "extras", "name", "pbrMetallicRoughness"};

constexpr std::array<std::string_view, 6> kUsedOfSurface = {
    "baseColorFactor", "baseColorTexture", "diffuseFactor", "diffuseTexture", "extensions", "extras"};

bool isIn(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws Error if a mesh is stored only with Draco compression (KHR_draco_mesh_compression). A file can contain such a
/// mesh without requiring the extension. The accessors of such a mesh have no buffer view.
void requireNoDraco(const json& document, const std::string& path) {
    const json accessors = arrayOf(document, "accessors", path);
    const auto hasBytes = [&](const json& primitive) {
        const auto at = json::json_pointer("/attributes/POSITION");
        const std::size_t index = primitive.contains(at) && primitive[at].is_number_unsigned()
                                      ? primitive[at].get<std::size_t>()
                                      : accessors.size();
        return index >= accessors.size() || accessors[index].contains("bufferView");
    };
    const auto packed = json::json_pointer("/extensions/KHR_draco_mesh_compression");
    for (const json& mesh : arrayOf(document, "meshes", path))
        if (mesh.is_object())
            for (const json& primitive : arrayOf(mesh, "primitives", path))
                if (primitive.is_object() && primitive.contains(packed) && !hasBytes(primitive))
                    throw Error(path, "requires an unsupported glTF extension: \"KHR_draco_mesh_compression\"");
}

/// Counts the parts of a glTF document that Gnomon does not use, by their names.
class PartCounter {
public:
    /// Counts the members of the JSON object `object` whose names are not in `used`.
    void countMembers(const json& object, std::span<const std::string_view> used) {
        if (!object.is_object()) return;
        for (const auto& [name, value] : object.items())
            if (!isIn(used, name)) ++counts_[name];
    }

    /// Counts the entries of the document's top-level lists that Gnomon does not use, such as animations.
    void countLists(const json& document) {
        for (const auto& [name, value] : document.items())
            if (!isIn(kUsedLists, name) && !value.empty()) counts_[name] = value.is_array() ? value.size() : 1;
    }

    /// Counts the glTF extensions and extras of `value` and of all its descendants. Skips the member `asset`, which
    /// only describes the author of the file. The recursion depth is bounded, because the nesting of JSON is limited.
    void countExtensions(const json& value) {
        if (value.is_array())
            for (const json& entry : value)
                countExtensions(entry);
        if (!value.is_object()) return;
        for (const auto& [name, member] : value.items()) {
            if (name == "extensions" && member.is_object())
                for (const auto& [extension, content] : member.items())
                    countExtension(extension);
            if (name == "extras")
                ++counts_[name];
            else if (name != "asset")
                countExtensions(member);
        }
    }

    void countExtension(const std::string& name) {
        const bool isCountedElsewhere = name == "KHR_lights_punctual";
        if (!isIn(kReadExtensions, name) && !isCountedElsewhere) ++counts_[name];
    }

    /// Counts the extension `name`, which the document declares as used. If objects with this extension were already
    /// counted, the function does nothing.
    void countAnnounced(const std::string& name) {
        if (!counts_.contains(name)) countExtension(name);
    }

    void count(const std::string& name, std::uint64_t count) {
        if (count > 0) counts_[name] += count;
    }

    const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

private:
    std::map<std::string, std::uint64_t> counts_;
};

} // namespace

json arrayOf(const json& object, const char* key, const std::string& path) {
    const auto found = object.find(key);
    if (found == object.end()) return json::array();
    if (!found->is_array())
        throw Error(path, "cannot be understood", std::string("\"") + key + "\" as an array", "another kind of value");
    return *found;
}

std::string textOf(const json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void requireVersion(const json& document, const std::string& path) {
    const json asset = document.value("asset", json());
    const std::string version = textOf(asset, "version");
    if (version != "2" && !version.starts_with("2."))
        throw Error(path, "not glTF 2.0", "\"2.0\" as the version of the asset", quotedForMessage(version));
    const std::string minVersion = textOf(asset, "minVersion");
    const bool isRead = minVersion.empty() || minVersion == "2" || minVersion == "2.0" || minVersion.starts_with("1.");
    if (!isRead)
        throw Error(
            path, "requires a newer version of glTF", "a minVersion of at most 2.0", quotedForMessage(minVersion));
}

void requireExtensions(const json& document, const std::string& path, bool readsTextures) {
    for (const json& name : arrayOf(document, "extensionsRequired", path)) {
        const std::string text = name.is_string() ? name.get<std::string>() : "a name that is none";
        if (isIn(kReadExtensions, text) || isIn(kHarmlessExtensions, text)) continue;
        if (!isIn(kTextureExtensions, text))
            throw Error(path, "requires an unsupported glTF extension: " + quotedForMessage(text));
        if (readsTextures)
            throw LimitError(Limit::Textures, {path, "requires an unsupported texture format", "PNG or JPEG", text});
    }
    requireNoDraco(document, path);
}

std::map<std::string, std::uint64_t> unusedParts(const json& document) {
    PartCounter counter;
    counter.countLists(document);
    counter.countExtensions(document);
    const auto lights = json::json_pointer("/extensions/KHR_lights_punctual/lights");
    if (document.contains(lights)) counter.count("lights", document[lights].size());
    const auto materials = document.find("materials");
    if (materials != document.end() && materials->is_array())
        for (const json& material : *materials) {
            counter.countMembers(material, kUsedOfMaterial);
            const auto specular = json::json_pointer("/extensions/KHR_materials_pbrSpecularGlossiness");
            if (!material.is_object()) continue;
            if (material.contains(specular))
                counter.countMembers(material[specular], kUsedOfSurface);
            else if (material.contains("pbrMetallicRoughness"))
                counter.countMembers(material["pbrMetallicRoughness"], kUsedOfSurface);
        }
    const auto announced = document.find("extensionsUsed");
    if (announced != document.end() && announced->is_array())
        for (const json& name : *announced)
            if (name.is_string()) counter.countAnnounced(name.get<std::string>());
    return counter.counts();
}

} // namespace gnomon::read
