// The check of files that an input refers to: buffers and images of a glTF, material libraries of an OBJ.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::read {

/// The folder that must contain all files that an input refers to. A mesh from an untrusted source must not choose
/// which other files are read.
class SourceRoot {
public:
    /// Uses the folder `root`, which the option --source-root names. If `root` is empty, uses the folder of `input`.
    SourceRoot(const std::string& input, const std::string& root);

    /// Returns the path of the file `name`, which is absolute or relative to the folder of the input. The path has no
    /// "..". Throws LimitError with the position `place` if the path is outside the root, and Error for a name with a
    /// zero byte. Symbolic links are resolved first, because an unpacked archive can contain links.
    std::string pathOf(const std::string& name, const std::string& place) const;

    /// Returns whether `path` is inside the root after the links in both paths are resolved.
    bool contains(const std::filesystem::path& path) const;

private:
    std::filesystem::path inputFolder_;
    std::filesystem::path root_;
};

} // namespace gnomon::read
