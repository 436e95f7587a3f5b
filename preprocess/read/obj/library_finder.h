// Search for the material libraries that the `mtllib` lines of an OBJ name.
#pragma once

#include "preprocess/read/source_root.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Finds material libraries by inexact names: with blanks, in quotes, with backslashes, with the wrong case, or with
/// the path of another computer. The number of file system searches is bounded, for any number of names.
class LibraryFinder {
public:
    /// Searches for libraries of the OBJ `path`. All libraries must be in the folder `sourceRoot` (see SourceRoot).
    LibraryFinder(const std::string& path, const std::string& sourceRoot);

    /// The files of one line of names.
    struct Found {
        std::vector<std::string> files;
        std::uint64_t missing = 0; ///< number of names without a file
    };

    /// Returns the files of `names`, the text after `mtllib`. A name can contain blanks: the longest sequence of words
    /// that is a file counts. If a path has no file, uses the file of the same name in the folder of the OBJ. Throws
    /// Error at `where` for a file outside the source root.
    Found filesOf(std::string_view names, const std::string& where);

    /// Returns a note for the user about a name that was not used literally; empty if there is none.
    const std::string& remark() const { return remark_; }

private:
    std::string fileOf(const std::string& name, const std::string& where);
    std::string searchedFileOf(const std::string& name, const std::string& where);
    std::string baseFileOf(const std::string& name, const std::string& where);
    const std::map<std::string, std::string>& namesIn(const std::string& folder);

    std::string folder_;
    SourceRoot root_;
    std::unordered_map<std::string, std::string> files_; ///< file per name; empty if there is none
    /// Per folder: file names by their lower-case names.
    std::map<std::string, std::map<std::string, std::string>> listings_;
    std::size_t searches_ = 0;
    std::string remark_;
};

} // namespace gnomon::read
