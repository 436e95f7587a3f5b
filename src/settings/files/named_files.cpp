#include "settings/files/named_files.h"

#include "settings/usage_error.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace gnomon::settings {

namespace {

namespace fs = std::filesystem;

/// Returns the absolute path of a file with all symbolic links resolved. The file does not have to exist.
fs::path placeOf(const std::string& path) {
    std::error_code error;
    const fs::path place = fs::weakly_canonical(fs::absolute(path), error);
    return error ? fs::absolute(path).lexically_normal() : place;
}

bool isSameFile(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    std::error_code error;
    if (!fs::exists(a, error) || !fs::exists(b, error)) return placeOf(a) == placeOf(b);
    return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
}

} // namespace

void requireDistinctFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        for (const NamedFile& input : inputs)
            if (isSameFile(input.path, output->path))
                throw UsageError{
                    output->option,
                    output->option + " would replace " + input.option + ", which is read: " + output->path};
        for (auto other = outputs.begin(); other != output; ++other)
            if (isSameFile(other->path, output->path))
                throw UsageError{
                    output->option, other->option + " and " + output->option + " name the same file: " + output->path};
    }
}

void requireExtension(const std::string& option, const std::string& path, const std::string& extension) {
    std::string found = fs::path(path).extension().string();
    std::transform(found.begin(), found.end(), found.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!found.empty() && found != extension) refuse(option, path, "a name ending in " + extension);
}

} // namespace gnomon::settings
