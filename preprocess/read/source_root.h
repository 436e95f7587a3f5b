// Restricts the files that an input may refer to, such as buffers and images of a glTF or material libraries of an OBJ,
// to one folder.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::read {

/// The folder that must contain all files that an input mesh refers to. Without this limit, a mesh from an untrusted
/// source could make Gnomon read any file.
class SourceRoot {
public:
    /// Uses the folder `root`, the value of the option --source-root. If `root` is empty, uses the folder of the file
    /// `input`.
    SourceRoot(const std::string& input, const std::string& root);

    /// Returns the path of the file `name`, to which the input refers. `name` is absolute or relative to the input's
    /// folder. The result has no "..". Symbolic links are resolved first, because an unpacked archive can contain
    /// links. Throws LimitError with the position `place` if the path is outside the folder. Throws Error if the name
    /// contains a zero byte.
    std::string pathOf(const std::string& name, const std::string& place) const;

    /// Returns true if `path` is inside the folder. Symbolic links in both paths are resolved first.
    bool contains(const std::filesystem::path& path) const;

private:
    std::filesystem::path inputFolder_;
    std::filesystem::path root_;
};

} // namespace gnomon::read
