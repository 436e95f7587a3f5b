#include "preprocess/read/gltf/gltf_file.h"

#include "core/error.h"
#include "core/json_file.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <meshoptimizer.h>

namespace gnomon::read {

namespace {

// What a parsed document takes for each value in it, twice for a while, and for a byte of its text, most of which is in
// strings where buffers are embedded.
constexpr std::uint64_t kBytesPerJsonValue = 160;
constexpr std::uint64_t kBytesPerJsonByte = 6;

constexpr std::uint32_t kGlbMagic = 0x46546C67; // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;

/// Extensions that may be required: what they say is read, or changes no surface and no base colour.
constexpr std::array kKnownExtensions = {
    "KHR_mesh_quantization",
    "EXT_meshopt_compression",
    "EXT_mesh_gpu_instancing",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
    "KHR_materials_clearcoat",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume"};

std::uint32_t word(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// The array `key` of an object of the document; an empty one where there is none.
nlohmann::json arrayOf(const nlohmann::json& object, const char* key, const std::string& path) {
    const auto found = object.find(key);
    if (found == object.end()) return nlohmann::json::array();
    if (!found->is_array())
        throw Error(path, "cannot be understood", std::string("\"") + key + "\" as an array", "another kind of value");
    return *found;
}

std::string textOf(const nlohmann::json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool isWhole(double value) {
    return value >= 0 && value < 9e15 && value == std::floor(value);
}

double numberOf(const tinygltf::Value& object, const char* key, double otherwise) {
    return object.IsObject() && object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble()
                                                                              : otherwise;
}

std::string wordOf(const tinygltf::Value& object, const char* key) {
    return object.IsObject() && object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

void requireExtensions(const nlohmann::json& document, const std::string& path) {
    for (const nlohmann::json& name : arrayOf(document, "extensionsRequired", path)) {
        const std::string text = name.is_string() ? name.get<std::string>() : "a name that is none";
        if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), text) == kKnownExtensions.end())
            throw Error(path, "needs an extension of glTF that is not read: " + quotedForMessage(text));
    }
}

/// Draco's geometry may be there without being announced as required; its accessors have no bytes of their own then.
void requireNoDraco(const nlohmann::json& document, const std::string& path) {
    const nlohmann::json accessors = arrayOf(document, "accessors", path);
    const auto hasBytes = [&](const nlohmann::json& primitive) {
        const auto at = nlohmann::json::json_pointer("/attributes/POSITION");
        const std::size_t index = primitive.contains(at) && primitive[at].is_number_unsigned()
                                      ? primitive[at].get<std::size_t>()
                                      : accessors.size();
        return index >= accessors.size() || accessors[index].contains("bufferView");
    };
    const auto packed = nlohmann::json::json_pointer("/extensions/KHR_draco_mesh_compression");
    for (const nlohmann::json& mesh : arrayOf(document, "meshes", path))
        if (mesh.is_object())
            for (const nlohmann::json& primitive : arrayOf(mesh, "primitives", path))
                if (primitive.is_object() && primitive.contains(packed) && !hasBytes(primitive))
                    throw Error(path, "needs an extension of glTF that is not read: \"KHR_draco_mesh_compression\"");
}

/// tinygltf's own words, which may be many lines.
std::string firstLineOf(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? "no reason given" : line;
}

} // namespace

std::string percentDecoded(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
        if (low >= 0) i += 2;
        text += low >= 0 ? static_cast<char>(high * 16 + low) : uri[i];
    }
    return text;
}

GltfFile::GltfFile(const std::string& path, Bytes limit) : room_(path, limit) {
    files_.push_back(std::make_unique<InputFile>(path));
    parse(readContainer());
    unpacked_.resize(model_.bufferViews.size());
}

std::string GltfFile::where(std::string_view name, std::uint64_t index) const {
    return path() + ": " + std::string(name) + " " + std::to_string(index);
}

std::uint64_t GltfFile::fileBytes() const {
    std::uint64_t sum = 0;
    for (const auto& file : files_)
        sum += file->size();
    return sum;
}

/// The text of the document; what a .glb holds beside it stays.
std::string GltfFile::readContainer() {
    const InputFile& file = *files_.front();
    std::array<std::byte, kGlbHeader + kChunkHeader> head{};
    const std::size_t got = file.readSomeAt(0, head);
    std::uint64_t begin = 0;
    std::uint64_t length = file.size();
    if (got >= 4 && word(head) == kGlbMagic) {
        if (got < head.size())
            throw Error(atByte(path(), got), "the file ends too early", "a header of 20 bytes", "the end");
        const std::span<const std::byte> bytes(head);
        if (word(bytes.subspan(4)) != 2)
            throw Error(path(), "not glTF 2.0", "version 2", std::to_string(word(bytes.subspan(4))));
        begin = head.size();
        length = word(bytes.subspan(kGlbHeader));
        if (word(bytes.subspan(kGlbHeader + 4)) != kJsonChunk || length > file.size() - begin)
            throw Error(
                atByte(path(), kGlbHeader), "not a .glb", "a chunk of JSON that lies within the file", "another");
    }
    room_.take(length, kBytesPerJsonByte);
    std::string text(length, '\0');
    file.readAt(begin, std::as_writable_bytes(std::span(text.data(), text.size())));
    const std::uint64_t end = begin + length;
    if (begin == 0 || file.size() - end < kChunkHeader) return text;
    std::array<std::byte, kChunkHeader> chunk{};
    file.readAt(end, chunk);
    const std::uint64_t binary = word(chunk);
    if (word(std::span<const std::byte>(chunk).subspan(4)) != kBinaryChunk) return text;
    if (binary > file.size() - end - kChunkHeader)
        throw Error(
            atByte(path(), end),
            "the file ends too early",
            std::to_string(binary) + " bytes of buffer",
            std::to_string(file.size() - end - kChunkHeader));
    room_.take(binary);
    embedded_.resize(binary);
    file.readAt(end + kChunkHeader, embedded_);
    return text;
}

void GltfFile::parse(const std::string& text) {
    requireJsonLimits(path(), text);
    const auto endsValue = [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; };
    room_.take(static_cast<std::uint64_t>(std::count_if(text.begin(), text.end(), endsValue)), kBytesPerJsonValue);
    Json document = Json::parse(text, nullptr, false);
    if (!document.is_object()) throw Error(path(), "not glTF", "an object of JSON", "something else");
    requireExtensions(document, path());
    requireNoDraco(document, path());
    leaveOut(document);
    readBuffers(document);
    const std::string structure = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    document = nullptr;
    tinygltf::TinyGLTF reader;
    std::string error;
    std::string warning;
    if (!reader.LoadASCIIFromString(
            &model_, &error, &warning, structure.data(), static_cast<unsigned int>(structure.size()), ""))
        throw Error(path(), "not glTF 2.0: " + firstLineOf(error));
}

/// Takes out what no surface needs, and what tinygltf would read by itself: images.
void GltfFile::leaveOut(Json& document) {
    images_ = arrayOf(document, "images", path());
    document.erase("images");
    for (const char* const name : {"animations", "skins"}) {
        const std::size_t count = arrayOf(document, name, path()).size();
        if (count > 0) leftOut_[name] = count;
        document.erase(name);
    }
    document.erase("cameras");
}

/// Reads all buffers and leaves tinygltf one of a byte for each.
void GltfFile::readBuffers(Json& document) {
    Json buffers = arrayOf(document, "buffers", path());
    for (std::size_t i = 0; i < buffers.size(); ++i)
        buffers_.push_back(bufferBytes(buffers[i], i));
    if (!buffers.empty())
        document["buffers"] =
            Json(buffers.size(), Json{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}});
}

std::vector<std::byte> GltfFile::bufferBytes(const Json& buffer, std::size_t index) {
    const std::string place = where("buffer", index);
    const auto length = buffer.is_object() ? buffer.find("byteLength") : buffer.end();
    if (!buffer.is_object() || length == buffer.end() || !length->is_number() || !isWhole(length->get<double>()))
        throw Error(place, "cannot be understood", "a byteLength of a whole number", "none");
    const auto asked = static_cast<std::uint64_t>(length->get<double>());
    const std::string uri = textOf(buffer, "uri");
    std::vector<std::byte> bytes;
    if (!uri.empty())
        bytes = ofUri(uri, place);
    else if (index == 0)
        bytes = std::move(embedded_);
    // A buffer without bytes is what EXT_meshopt_compression leaves in place of what it packs: nobody asks for it.
    if (bytes.size() < asked && !(uri.empty() && bytes.empty()))
        throw Error(place, "too short", std::to_string(asked) + " bytes", std::to_string(bytes.size()));
    return bytes;
}

std::vector<std::byte> GltfFile::ofUri(const std::string& uri, const std::string& place) {
    if (!uri.starts_with("data:")) return ofFile(uri, place);
    room_.take(uri.size(), 2);
    std::vector<unsigned char> bytes;
    std::string type;
    if (!tinygltf::IsDataURI(uri) || !tinygltf::DecodeDataURI(&bytes, type, uri, 0, false))
        throw Error(place, "cannot be understood", "base64 of bytes, a PNG or a JPEG", quotedForMessage(uri));
    const auto held = std::as_bytes(std::span(bytes));
    return {held.begin(), held.end()};
}

std::vector<std::byte> GltfFile::ofFile(const std::string& uri, const std::string& place) {
    const std::filesystem::path name = percentDecoded(uri);
    if (name.is_absolute() || uri.find("://") != std::string::npos)
        throw Error(
            place, "refers to a file by more than a name", "a path from the folder of the file", quotedForMessage(uri));
    const std::string path = (std::filesystem::path(this->path()).parent_path() / name).string();
    requireRereadable(path);
    auto file = std::make_unique<InputFile>(path);
    room_.take(file->size());
    std::vector<std::byte> bytes(file->size());
    file->readAt(0, bytes);
    files_.push_back(std::move(file));
    return bytes;
}

std::span<const std::byte> GltfFile::inBuffer(
    std::string_view name, int view, double buffer, double offset, double length) {
    const std::string place = where(name, static_cast<std::uint64_t>(view));
    if (!isWhole(buffer) || buffer >= static_cast<double>(buffers_.size()))
        throw Error(place, "no such buffer", "one of " + std::to_string(buffers_.size()), std::to_string(buffer));
    const std::vector<std::byte>& bytes = buffers_[static_cast<std::size_t>(buffer)];
    if (!isWhole(offset) || !isWhole(length) || offset + length > static_cast<double>(bytes.size()))
        throw Error(
            place,
            "lies outside of its buffer",
            "within " + std::to_string(bytes.size()) + " bytes",
            std::to_string(length) + " bytes from " + std::to_string(offset));
    return std::span(bytes).subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::span<const std::byte> GltfFile::bufferView(int index) {
    const tinygltf::BufferView& view = elementOf(model_.bufferViews, index, "buffer view");
    const auto packed = view.extensions.find("EXT_meshopt_compression");
    if (packed == view.extensions.end())
        return inBuffer(
            "buffer view",
            index,
            view.buffer,
            static_cast<double>(view.byteOffset),
            static_cast<double>(view.byteLength));
    std::vector<std::byte>& bytes = unpacked_[static_cast<std::size_t>(index)];
    if (bytes.empty()) bytes = unpacked(index, packed->second);
    return bytes;
}

std::vector<std::byte> GltfFile::unpacked(int view, const tinygltf::Value& packed) {
    const std::string place = where("buffer view", static_cast<std::uint64_t>(view));
    const std::span<const std::byte> from = inBuffer(
        "buffer view",
        view,
        numberOf(packed, "buffer", -1),
        numberOf(packed, "byteOffset", 0),
        numberOf(packed, "byteLength", -1));
    const std::string mode = wordOf(packed, "mode");
    const std::string filter = wordOf(packed, "filter");
    const double asked = numberOf(packed, "count", -1);
    const double size = numberOf(packed, "byteStride", -1);
    const bool isOctahedral = filter == "OCTAHEDRAL";
    const bool isOfVertices = mode == "ATTRIBUTES" && size >= 4 && size <= 256 && std::fmod(size, 4) == 0;
    const bool isOfIndices = (mode == "TRIANGLES" || mode == "INDICES") && (size == 2 || size == 4);
    if (!isWhole(asked) || !(isOfVertices || isOfIndices) || (mode == "TRIANGLES" && std::fmod(asked, 3) != 0))
        throw Error(place, "its EXT_meshopt_compression cannot be understood");
    if (!(filter.empty() || filter == "NONE" || (isOctahedral && (size == 4 || size == 8))))
        throw Error(place, "a filter of EXT_meshopt_compression that is not read: " + quotedForMessage(filter));
    const auto count = static_cast<std::size_t>(asked);
    const auto stride = static_cast<std::size_t>(size);
    room_.take(count, stride);
    std::vector<std::byte> bytes(count * stride);
    const auto* data = reinterpret_cast<const unsigned char*>(from.data());
    const int failed = mode == "ATTRIBUTES" ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, from.size())
                       : mode == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, from.size())
                           : meshopt_decodeIndexSequence(bytes.data(), count, stride, data, from.size());
    if (failed != 0) throw Error(place, "its EXT_meshopt_compression is damaged");
    if (isOctahedral) meshopt_decodeFilterOct(bytes.data(), count, stride);
    return bytes;
}

std::vector<std::byte> GltfFile::image(int index) {
    if (index < 0 || index >= static_cast<int>(images_.size()))
        throw Error(path(), "no such image", "one of " + std::to_string(images_.size()), std::to_string(index));
    const Json& image = images_[static_cast<std::size_t>(index)];
    const std::string uri = textOf(image, "uri");
    if (uri.empty()) {
        const auto view = image.is_object() ? image.find("bufferView") : image.end();
        if (!image.is_object() || view == image.end() || !view->is_number_integer()) return {};
        const std::span<const std::byte> bytes =
            bufferView(static_cast<int>(std::min<std::int64_t>(view->get<std::int64_t>(), 1 << 30)));
        return {bytes.begin(), bytes.end()};
    }
    if (uri.starts_with("data:")) return ofUri(uri, where("image", static_cast<std::uint64_t>(index)));
    std::error_code missing;
    const auto file = std::filesystem::path(path()).parent_path() / percentDecoded(uri);
    if (!std::filesystem::is_regular_file(file, missing)) return {};
    return ofFile(uri, where("image", static_cast<std::uint64_t>(index)));
}

} // namespace gnomon::read
