#include "preprocess/read/source_root.h"

#include "core/limit_error.h"
#include "preprocess/read/words.h"

#include <system_error>

namespace gnomon::read {

namespace {

bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const std::filesystem::path rest = path.lexically_relative(folder);
    return !rest.empty() && *rest.begin() != "..";
}

} // namespace

SourceRoot::SourceRoot(const std::string& input, const std::string& root)
    : inputFolder_(std::filesystem::path(input).parent_path()),
      root_(root.empty() ? inputFolder_ : std::filesystem::path(root)) {
    if (root_.empty()) root_ = ".";
}

std::string SourceRoot::pathOf(const std::string& name, const std::string& place) const {
    if (name.find('\0') != std::string::npos)
        throw Error(place, "refers to a file whose name has a zero byte (%00)", "a name", quotedForMessage(name));
    const std::filesystem::path path = (inputFolder_ / name).lexically_normal();
    if (!contains(path))
        throw LimitError(
            Limit::SourceRoot,
            {place,
             "refers to a file outside the folder of the source",
             "a path below " + root_.string(),
             quotedForMessage(name)});
    return path.string();
}

bool SourceRoot::contains(const std::filesystem::path& path) const {
    std::error_code ignored;
    const std::filesystem::path real = std::filesystem::weakly_canonical(path, ignored);
    if (ignored) return false;
    const std::filesystem::path realRoot = std::filesystem::weakly_canonical(root_, ignored);
    return !ignored && isBelow(real, realRoot);
}

} // namespace gnomon::read
