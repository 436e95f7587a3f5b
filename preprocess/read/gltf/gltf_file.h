// A glTF 2.0 file, .gltf or .glb, with the bytes that it refers to.
#pragma once

#include "preprocess/read/gltf/memory_room.h"
#include "preprocess/read/input_file.h"
#include "preprocess/read/source_root.h"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace gnomon::read {

/// Scenes, nodes, meshes, accessors and materials as tinygltf parses them. This class itself reads buffers and images,
/// checks their sizes and returns their bytes. It counts the data that no model uses, such as animations.
class GltfFile {
public:
    /// Throws Error, which names the file, if the file is not glTF 2.0, lacks a buffer, requires an extension that is
    /// not read (Draco's among them), or may take more than `limit`. A file may require a format of textures that is
    /// not read only if the caller reads no textures. Files that it refers to obey the rule of SourceRoot.
    GltfFile(const std::string& path, Bytes limit, bool readsTextures = true, const std::string& sourceRoot = {});

    const std::string& path() const { return files_.front()->path(); }

    const tinygltf::Model& model() const { return model_; }

    /// The bytes of a buffer view, unpacked if EXT_meshopt_compression packs them; valid as long as the file. Throws
    /// Error where they lie outside of their buffer or are damaged.
    std::span<const std::byte> bufferView(int index);

    /// The encoded image `index`; empty where its file is not there.
    std::vector<std::byte> image(int index);

    /// The cameras of the document, of which tinygltf parses nothing.
    const nlohmann::json& cameras() const { return cameras_; }

    /// Of this file and of all that it refers to and that was read.
    std::uint64_t fileBytes() const;

    const std::map<std::string, std::uint64_t>& leftOut() const { return leftOut_; }

    MemoryRoom& room() { return room_; }

    /// The files that were read, for those who ask later whether they changed; ends the use of this object.
    std::vector<std::unique_ptr<InputFile>> takeFiles() && { return std::move(files_); }

    /// Element `index` of one of the model's lists. Throws Error that calls it `name` if there is none.
    template <class T>
    const T& elementOf(const std::vector<T>& list, int index, const char* name) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            throw Error(
                path(), std::string("no such ") + name, "one of " + std::to_string(list.size()), std::to_string(index));
        return list[static_cast<std::size_t>(index)];
    }

    /// "PATH: NAME N", the place of an error.
    std::string where(std::string_view name, std::uint64_t index) const;

private:
    using Json = nlohmann::json;

    std::string readContainer();
    std::string textAt(std::uint64_t offset, std::uint64_t length);
    void parse(const std::string& text, bool readsTextures);
    void leaveOut(Json& document);
    void readBuffers(Json& document);
    std::vector<std::byte> bufferBytes(const Json& buffer, std::size_t index);
    std::vector<std::byte> ofUri(const std::string& uri, const std::string& place);
    std::vector<std::byte> ofFile(const std::string& path);
    std::string besideThis(const std::string& uri, const std::string& place) const;
    std::span<const std::byte> inBuffer(std::string_view name, int view, double buffer, double offset, double length);
    std::vector<std::byte> unpacked(int view, const tinygltf::Value& packed);

    std::vector<std::unique_ptr<InputFile>> files_; // this one first
    SourceRoot root_;
    MemoryRoom room_;
    std::vector<std::byte> embedded_; // what a .glb holds for its first buffer
    std::vector<std::vector<std::byte>> buffers_;
    std::vector<std::vector<std::byte>> unpacked_; // by view
    Json images_;
    Json cameras_;
    std::map<std::string, std::uint64_t> leftOut_;
    tinygltf::Model model_;
};

} // namespace gnomon::read
