// A glTF 2.0 file (.gltf or .glb), with the buffers and images that it refers to.
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

/// A parsed glTF file. tinygltf parses scenes, nodes, meshes, accessors and materials. This class itself reads buffers
/// and images, checks their sizes and returns their bytes. It counts the data that no model uses, such as animations.
class GltfFile {
public:
    /// Opens and parses the file. Throws Error, which names the file, if it is not glTF 2.0, lacks a buffer, requires
    /// an extension that is not read (such as Draco's), or can need more than `limit`. A required texture format that
    /// is not read is an error only if `readsTextures`. Files that it refers to must satisfy the rule of SourceRoot.
    GltfFile(const std::string& path, Bytes limit, bool readsTextures = true, const std::string& sourceRoot = {});

    const std::string& path() const { return files_.front()->path(); }

    const tinygltf::Model& model() const { return model_; }

    /// Returns the bytes of a buffer view, decoded if it uses EXT_meshopt_compression. They are valid as long as this
    /// object. Throws Error if they are outside their buffer or damaged.
    std::span<const std::byte> bufferView(int index);

    /// Returns the encoded bytes of image `index`; empty if its file is missing.
    std::vector<std::byte> image(int index);

    /// Returns the cameras of the document as JSON, because tinygltf does not parse them.
    const nlohmann::json& cameras() const { return cameras_; }

    /// Returns the total size in bytes of this file and of all files that were read because it refers to them.
    std::uint64_t fileBytes() const;

    /// Returns the names and counts of the data that is not used.
    const std::map<std::string, std::uint64_t>& rejected() const { return rejected_; }

    /// Returns the memory budget of the file.
    MemoryRoom& room() { return room_; }

    /// Returns the files that were read, so that the caller can check later whether they changed. This object must not
    /// be used afterwards.
    std::vector<std::unique_ptr<InputFile>> takeFiles() && { return std::move(files_); }

    /// Returns element `index` of a list of the model. Throws Error, which calls the element `name`, if there is none.
    template <class T>
    const T& elementOf(const std::vector<T>& list, int index, const char* name) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            throw Error(
                path(), std::string("no such ") + name, "one of " + std::to_string(list.size()), std::to_string(index));
        return list[static_cast<std::size_t>(index)];
    }

    /// Returns "PATH: NAME N", the position of an error.
    std::string where(std::string_view name, std::uint64_t index) const;

private:
    using Json = nlohmann::json;

    std::string readContainer();
    std::string textAt(std::uint64_t offset, std::uint64_t length);
    void parse(const std::string& text, bool readsTextures);
    void reject(Json& document);
    void readBuffers(Json& document);
    std::vector<std::byte> bufferBytes(const Json& buffer, std::size_t index);
    std::vector<std::byte> ofUri(const std::string& uri, const std::string& place);
    std::vector<std::byte> ofFile(const std::string& path);
    std::string siblingPath(const std::string& uri, const std::string& place) const;
    std::span<const std::byte> inBuffer(std::string_view name, int view, double buffer, double offset, double length);
    std::vector<std::byte> unpacked(int view, const tinygltf::Value& packed);

    std::vector<std::unique_ptr<InputFile>> files_; // the .gltf or .glb itself is first
    SourceRoot root_;
    MemoryRoom room_;
    std::vector<std::byte> embedded_; // the binary chunk of a .glb, used as its first buffer
    std::vector<std::vector<std::byte>> buffers_;
    std::vector<std::vector<std::byte>> unpacked_; // decoded bytes by buffer view
    Json images_;
    Json cameras_;
    std::map<std::string, std::uint64_t> rejected_;
    tinygltf::Model model_;
};

} // namespace gnomon::read
