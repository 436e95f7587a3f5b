// Reads a glTF 2.0 file (.gltf or .glb), with the buffers and images that it refers to.
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

/// A parsed glTF file. tinygltf parses its scenes, nodes, meshes, accessors and materials. This class reads buffers and
/// images, checks their sizes and returns their bytes. It counts the data that Gnomon does not use, such as animations.
class GltfFile {
public:
    /// Opens and parses the glTF file `path`. Throws Error, which names the file, if it is not glTF 2.0, lacks a
    /// buffer, requires an unsupported extension (such as Draco compression), or could need more memory than `limit`.
    /// An unsupported texture format is an error only if `readsTextures` is true. All files that it refers to must be
    /// in the folder `sourceRoot` (see SourceRoot).
    GltfFile(const std::string& path, Bytes limit, bool readsTextures = true, const std::string& sourceRoot = {});

    const std::string& path() const { return files_.front()->path(); }

    const tinygltf::Model& model() const { return model_; }

    /// Returns the bytes of the buffer view with the index `index`, decoded if it uses EXT_meshopt_compression. The
    /// bytes are valid as long as this object exists. Throws Error if they are outside their buffer or damaged.
    std::span<const std::byte> bufferView(int index);

    /// Returns the encoded bytes (PNG or JPEG) of the image with the index `index`. Returns an empty array if the image
    /// file is missing.
    std::vector<std::byte> image(int index);

    /// Returns the cameras of the glTF document as JSON, because tinygltf does not parse them.
    const nlohmann::json& cameras() const { return cameras_; }

    /// Returns the total size in bytes of the glTF file and of all files that it refers to and that were read.
    std::uint64_t fileBytes() const;

    /// Returns the names and counts of the data in the file that Gnomon does not use.
    const std::map<std::string, std::uint64_t>& rejected() const { return rejected_; }

    /// Returns the budget that limits the memory for reading this file.
    MemoryRoom& room() { return room_; }

    /// Returns all files that were read, so that the caller can check later whether they changed. The GltfFile must not
    /// be used afterwards.
    std::vector<std::unique_ptr<InputFile>> takeFiles() && { return std::move(files_); }

    /// Returns the element with the index `index` of a list of the glTF file, such as its meshes. Throws Error, which
    /// calls the element `name`, if it does not exist.
    template <class T>
    const T& elementOf(const std::vector<T>& list, int index, const char* name) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            throw Error(
                path(), std::string("no such ") + name, "one of " + std::to_string(list.size()), std::to_string(index));
        return list[static_cast<std::size_t>(index)];
    }

    /// Returns the text "PATH: NAME N" for error messages.
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

    std::vector<std::unique_ptr<InputFile>> files_; // the first file is the .gltf or .glb itself
    SourceRoot root_;
    MemoryRoom room_;
    std::vector<std::byte> embedded_; // the binary chunk of a .glb file, which is its first buffer
    std::vector<std::vector<std::byte>> buffers_;
    std::vector<std::vector<std::byte>> unpacked_; // decoded bytes per buffer view
    Json images_;
    Json cameras_;
    std::map<std::string, std::uint64_t> rejected_;
    tinygltf::Model model_;
};

} // namespace gnomon::read
