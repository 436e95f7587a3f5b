// Checks of the files on a command line: an output must not overwrite an input or another output.
#pragma once

#include <string>
#include <vector>

namespace gnomon::settings {

/// A file and the option that names it. The path is empty if the option is not given.
struct NamedFile {
    std::string option;
    std::string path;
};

/// Throws UsageError if an output is the same file as an input or another output, also under another path or link.
/// Devices and pipes can occur several times, because they store nothing.
void requireDistinctFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws UsageError if `path` has an extension other than `extension` (".png"). A name without an extension, such as a
/// device, is valid.
void requireExtension(const std::string& option, const std::string& path, const std::string& extension);

} // namespace gnomon::settings
