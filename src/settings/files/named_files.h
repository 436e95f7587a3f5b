// The files that a command line names: none that is written may be one that is read, or written twice.
#pragma once

#include <string>
#include <vector>

namespace gnomon::settings {

/// A file and the option that names it; an empty path is an option that was not given.
struct NamedFile {
    std::string option;
    std::string path;
};

/// Throws UsageError where an output is the same file as an input or as another output, under whatever name. Devices
/// and pipes, which keep nothing, may be named twice.
void requireApart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws UsageError where `path` ends in another extension than `extension` (".png"), which would promise another
/// format; a name without one, like a device's, promises nothing.
void requireExtension(const std::string& option, const std::string& path, const std::string& extension);

} // namespace gnomon::settings
