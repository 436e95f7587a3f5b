#include "preprocess/read/gltf/gltf_file.h"

#include "core/error.h"
#include "core/formatted.h"
#include "core/json_file.h"
#include "preprocess/read/gltf/gltf_document.h"
#include "preprocess/read/gltf/uri.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <meshoptimizer.h>

namespace gnomon::read {

namespace {

// The max memory of a parsed glTF document, per JSON value and per byte of text. The document temporarily exists twice
// in memory. If buffers are embedded, most of the text is in strings.
constexpr std::uint64_t kBytesPerJsonValue = 160;
constexpr std::uint64_t kBytesPerJsonByte = 6;

constexpr std::uint32_t kGlbMagic = 0x46546C67; // the characters "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;

std::uint32_t word(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
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

/// The range of bytes of a chunk of a .glb file, without the chunk's header.
struct Chunk {
    std::uint64_t begin = 0;
    std::uint64_t length = 0;
    std::uint32_t type = 0;

    std::uint64_t end() const { return begin + length; }
};

/// Returns the chunk of a .glb file whose header is at byte `at`. Throws Error if the chunk does not end before byte
/// `end`.
Chunk chunkAt(const InputFile& file, std::uint64_t at, std::uint64_t end) {
    std::array<std::byte, kChunkHeader> head{};
    file.readAt(at, head);
    const Chunk chunk{at + head.size(), word(head), word(std::span<const std::byte>(head).subspan(4))};
    if (chunk.length > end - chunk.begin)
        throw Error(
            atByte(file.path(), at),
            "a chunk of the .glb ends after the file",
            "at most " + std::to_string(end - chunk.begin) + " bytes",
            std::to_string(chunk.length));
    return chunk;
}

/// Returns the first line of an error message of tinygltf, which can have many lines.
std::string firstLineOf(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? "no reason given" : line;
}

} // namespace

GltfFile::GltfFile(const std::string& path, Bytes limit, bool readsTextures, const std::string& sourceRoot)
    : root_(path, sourceRoot), room_(path, limit) {
    files_.push_back(std::make_unique<InputFile>(path));
    parse(readContainer(), readsTextures);
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

/// Returns the JSON text of the glTF file. For a .glb, the function also reads the first binary chunk. It skips and
/// counts all other chunks (glTF 2.0, section 4.4.3).
std::string GltfFile::readContainer() {
    const InputFile& file = *files_.front();
    std::array<std::byte, kGlbHeader> head{};
    const std::size_t got = file.readSomeAt(0, head);
    if (got < 4 || word(head) != kGlbMagic) return textAt(0, file.size());
    if (file.size() < kGlbHeader + kChunkHeader)
        throw Error(path(), "the file ends too early", "a header of 20 bytes", std::to_string(file.size()));
    const std::span<const std::byte> bytes(head);
    if (word(bytes.subspan(4)) != 2)
        throw Error(path(), "not glTF 2.0", "version 2", std::to_string(word(bytes.subspan(4))));
    const std::uint64_t end = word(bytes.subspan(8));
    if (end > file.size() || end < kGlbHeader + kChunkHeader)
        throw Error(
            atByte(path(), 8),
            end > file.size() ? "the file ends too early" : "the .glb has a wrong length",
            "20 to " + std::to_string(file.size()) + " bytes, the size of the file",
            std::to_string(end));
    const Chunk first = chunkAt(file, kGlbHeader, end);
    if (first.type != kJsonChunk)
        throw Error(atByte(path(), kGlbHeader), "not a .glb", "a first chunk of JSON", "another type");
    std::string text = textAt(first.begin, first.length);
    bool hasBinary = false;
    for (std::uint64_t at = first.end(); end - at >= kChunkHeader;) {
        const Chunk chunk = chunkAt(file, at, end);
        if (chunk.type == kBinaryChunk && !hasBinary) {
            hasBinary = true;
            room_.take(chunk.length);
            embedded_.resize(chunk.length);
            file.readAt(chunk.begin, embedded_);
        } else {
            ++rejected_["chunks of other types"];
        }
        at = chunk.end();
    }
    return text;
}

std::string GltfFile::textAt(std::uint64_t offset, std::uint64_t length) {
    room_.take(length, kBytesPerJsonByte);
    std::string text(length, '\0');
    files_.front()->readAt(offset, std::as_writable_bytes(std::span(text.data(), text.size())));
    return text;
}

void GltfFile::parse(const std::string& text, bool readsTextures) {
    requireJsonLimits(path(), text);
    const auto endsValue = [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; };
    room_.take(static_cast<std::uint64_t>(std::count_if(text.begin(), text.end(), endsValue)), kBytesPerJsonValue);
    Json document = Json::parse(text, nullptr, false);
    if (!document.is_object()) throw Error(path(), "not glTF", "a JSON object", "other data");
    requireVersion(document, path());
    requireExtensions(document, path(), readsTextures);
    reject(document);
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

/// Counts the data that Gnomon does not use, and removes from `document` the parts that tinygltf must not parse.
void GltfFile::reject(Json& document) {
    rejected_.merge(unusedParts(document));
    images_ = arrayOf(document, "images", path());
    cameras_ = arrayOf(document, "cameras", path());
    for (const char* const name : {"images", "cameras", "animations", "skins"})
        document.erase(name);
    const auto extensions = document.find("extensions");
    if (extensions != document.end() && extensions->is_object()) extensions->erase("KHR_lights_punctual");
}

/// Reads all buffers of the glTF file. In `document`, it replaces each buffer by a buffer of one byte, so that tinygltf
/// does not read the buffers again.
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
        throw Error(place, "its byteLength is missing or not a whole number", "a number of bytes", "none");
    const auto asked = static_cast<std::uint64_t>(length->get<double>());
    const std::string uri = textOf(buffer, "uri");
    std::vector<std::byte> bytes;
    if (!uri.empty())
        bytes = ofUri(uri, place);
    else if (index == 0)
        bytes = std::move(embedded_);
    // EXT_meshopt_compression uses a buffer without bytes as a placeholder for decoded data. Such a buffer may be
    // empty, because it is never read.
    if (bytes.size() < asked && !(uri.empty() && bytes.empty()))
        throw Error(place, "too short", std::to_string(asked) + " bytes", std::to_string(bytes.size()));
    return bytes;
}

std::vector<std::byte> GltfFile::ofUri(const std::string& uri, const std::string& place) {
    if (!isDataUri(uri)) return ofFile(siblingPath(uri, place));
    room_.take(uri.size());
    return bytesOfDataUri(uri, place);
}

/// Returns the path of the file that `uri` names. Throws Error for a URI with a scheme, such as "http://".
std::string GltfFile::siblingPath(const std::string& uri, const std::string& place) const {
    if (uri.find("://") != std::string::npos)
        throw Error(place, "the uri is not a plain path", "a path from the folder of the file", quotedForMessage(uri));
    std::string path = root_.pathOf(fileNameOf(uri, place), place);
    std::error_code missing;
    requirePercentDigits(uri, std::filesystem::exists(path, missing), place);
    return path;
}

std::vector<std::byte> GltfFile::ofFile(const std::string& path) {
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
        throw Error(
            place, "no such buffer", "an index below " + std::to_string(buffers_.size()), formatted("%g", buffer));
    const std::vector<std::byte>& bytes = buffers_[static_cast<std::size_t>(buffer)];
    if (!isWhole(offset) || !isWhole(length) || offset + length > static_cast<double>(bytes.size()))
        throw Error(
            place,
            "the range is outside its buffer",
            "within " + std::to_string(bytes.size()) + " bytes",
            formatted("%.15g bytes from byte %.15g on", length, offset));
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
        throw Error(place, "EXT_meshopt_compression has invalid values");
    if (!(filter.empty() || filter == "NONE" || (isOctahedral && (size == 4 || size == 8))))
        throw Error(place, "unsupported filter of EXT_meshopt_compression: " + quotedForMessage(filter));
    const auto count = static_cast<std::size_t>(asked);
    const auto stride = static_cast<std::size_t>(size);
    room_.take(count, stride);
    std::vector<std::byte> bytes(count * stride);
    const auto* data = reinterpret_cast<const unsigned char*>(from.data());
    const int failed = mode == "ATTRIBUTES" ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, from.size())
                       : mode == "TRIANGLES"
                           ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, from.size())
                           : meshopt_decodeIndexSequence(bytes.data(), count, stride, data, from.size());
    if (failed != 0) throw Error(place, "the data of EXT_meshopt_compression is damaged");
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
    const std::string place = where("image", static_cast<std::uint64_t>(index));
    if (isDataUri(uri)) return ofUri(uri, place);
    const std::string file = siblingPath(uri, place);
    std::error_code missing;
    if (!std::filesystem::is_regular_file(file, missing)) return {};
    return ofFile(file);
}

} // namespace gnomon::read
