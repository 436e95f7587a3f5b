// Checks the JSON of a glTF file before tinygltf parses it: version, required extensions, and parts that Gnomon does
// not use.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace gnomon::read {

/// Returns the JSON array in the member `key` of `object`. Returns an empty array if the member is missing. Throws
/// Error, which names the file `path`, if the member is not an array.
nlohmann::json arrayOf(const nlohmann::json& object, const char* key, const std::string& path);

/// Returns the text in the member `key` of a JSON object. Returns an empty text if there is none.
std::string textOf(const nlohmann::json& object, const char* key);

/// Throws Error, which names the file `path`, unless the glTF version of the document is 2.x and its minVersion is at
/// most 2.0 (glTF 2.0, section 3.2).
void requireVersion(const nlohmann::json& document, const std::string& path);

/// Throws Error if the glTF document requires an unsupported extension. An unsupported texture format is an error only
/// if `readsTextures` is true. Throws Error also for a mesh that is stored only with Draco compression.
void requireExtensions(const nlohmann::json& document, const std::string& path, bool readsTextures);

/// Returns the names and counts of the parts of the glTF document that Gnomon does not use. They are entries of lists
/// such as animations, lights, members of materials, and objects with an unsupported extension. Meshes, nodes and
/// cameras are not included, because their readers count them.
std::map<std::string, std::uint64_t> unusedParts(const nlohmann::json& document);

} // namespace gnomon::read
