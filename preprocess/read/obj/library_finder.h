// Finds the material library files that the `mtllib` lines of an OBJ file name.
#pragma once

#include "preprocess/read/source_root.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Finds material library files by inexact names. A name can contain blanks, quotes or backslashes, have the wrong
/// case, or contain the path of another computer. The number of searches in the file system is bounded for any number
/// of names.
class LibraryFinder {
public:
    /// Searches for material libraries of the OBJ file `path`. All libraries must be in the folder `sourceRoot` (see
    /// SourceRoot).
    LibraryFinder(const std::string& path, const std::string& sourceRoot);

    /// The library files that one `mtllib` line refers to.
    struct Found {
        std::vector<std::string> files;
        std::uint64_t missing = 0; ///< number of names for which no file was found
    };

    /// Returns the library files that `names`, the text after `mtllib`, refers to. Because a name can contain blanks,
    /// the longest sequence of words that is an existing file counts as one name. If a path does not exist, the
    /// function tries its file name in the folder of the OBJ file. Throws Error, which names `where`, for a file
    /// outside the source root.
    Found filesOf(std::string_view names, const std::string& where);

    /// Returns a note for the user about a library whose file name differs from the requested name. The note is empty
    /// if there is no such library.
    const std::string& remark() const { return remark_; }

private:
    std::string fileOf(const std::string& name, const std::string& where);
    std::string searchedFileOf(const std::string& name, const std::string& where);
    std::string baseFileOf(const std::string& name, const std::string& where);
    const std::map<std::string, std::string>& namesIn(const std::string& folder);

    std::string folder_;
    SourceRoot root_;
    std::unordered_map<std::string, std::string> files_; ///< per requested name: the file found; empty if there is none
    /// Per folder: its file names, indexed by their lower-case form.
    std::map<std::string, std::map<std::string, std::string>> listings_;
    std::size_t searches_ = 0;
    std::string remark_;
};

} // namespace gnomon::read
