// Checks the JSON of a glTF file before tinygltf parses it: version, required extensions, and parts that Gnomon does
// not use.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::read {

/// Returns the array `key` of `object`. Returns an empty array if there is none. Throws Error, which names the file
/// `path`, if the value is not an array.
nlohmann::json arrayOf(const nlohmann::json& object, const char* key, const std::string& path);

/// Returns the text `key` of `object`. Returns an empty text if there is none.
std::string textOf(const nlohmann::json& object, const char* key);

/// Throws Error, which names the file `path`, unless the document's version is 2.x and its minVersion is at most 2.0
/// (glTF 2.0, section 3.2).
void requireVersion(const nlohmann::json& document, const std::string& path);

/// Throws Error if the document requires an unsupported extension. An extension with a texture format matters only if
/// `readsTextures` is true. Throws Error also for a mesh that is stored only in the extension of Draco.
void requireExtensions(const nlohmann::json& document, const std::string& path, bool readsTextures);

/// Returns the names and counts of the parts of the document that a model does not use. They are entries of lists such
/// as animations, lights, members of materials, and objects with an unsupported extension. Meshes, nodes and cameras
/// are not included, because their readers count them.
std::map<std::string, std::uint64_t> unusedParts(const nlohmann::json& document);

} // namespace gnomon::read
