// The files that `mtllib` lines of an OBJ mean.
#pragma once

#include "preprocess/read/source_root.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::read {

/// Finds material libraries as people name them: with blanks, in quotes, with backslashes, with letters of the wrong
/// case, and by paths of the machine that wrote the OBJ. The work has a bound, whatever the number of names.
class LibraryFinder {
public:
    /// Of the OBJ `path`. `sourceRoot` is the folder that libraries may come from (see SourceRoot).
    LibraryFinder(const std::string& path, const std::string& sourceRoot);

    /// What a line of names means.
    struct Found {
        std::vector<std::string> files;
        std::uint64_t missing = 0; ///< names that no file has
    };

    /// Returns the files of `names`, which follow `mtllib`. Names may contain blanks: of all ways to join words, the
    /// longest that is a file counts. A path without a file stands for the file of that name in the folder of the OBJ.
    /// Throws Error at `where` for a file outside of the source root.
    Found filesOf(std::string_view names, const std::string& where);

    /// Returns what a user should know of names that were not taken literally; empty for nothing.
    const std::string& remark() const { return remark_; }

private:
    std::string fileOf(const std::string& name, const std::string& where);
    std::string searchedFileOf(const std::string& name, const std::string& where);
    std::string baseFileOf(const std::string& name, const std::string& where);
    const std::map<std::string, std::string>& namesIn(const std::string& folder);

    std::string folder_;
    SourceRoot root_;
    std::unordered_map<std::string, std::string> files_;                 ///< by name; empty where there is none
    std::map<std::string, std::map<std::string, std::string>> listings_; ///< by folder: names by names in lower case
    std::size_t searches_ = 0;
    std::string remark_;
};

} // namespace gnomon::read
