// Checks the files on a command line. An output must not overwrite an input or another output.
#pragma once

#include <string>
#include <vector>

namespace gnomon::settings {

/// A file on the command line, and the option that names it. The path is empty if the user does not give the option.
struct NamedFile {
    std::string option;
    std::string path;
};

/// Throws UsageError if an output is the same file as an input or another output. Different paths and links to one file
/// are detected. A device or pipe may occur several times, because it stores nothing.
void requireDistinctFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws UsageError if the name of an output file has an extension other than `extension` (".png"). A name without an
/// extension, such as a device, is valid.
void requireExtension(const std::string& option, const std::string& path, const std::string& extension);

} // namespace gnomon::settings
