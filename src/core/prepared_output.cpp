#include "core/prepared_output.h"

#include "core/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace gnomon {

void PreparedFile::write(const std::string& text) {
    if (!file_) return;
    file_->file().writeAt(0, std::as_bytes(std::span(text)));
    file_->commit();
}

void requireWritable(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    const bool isOther = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                         !std::filesystem::is_directory(status);
    if (!path.empty() && !isOther) const AtomicFile trial(path);
}

PreparedFolder::PreparedFolder(const std::string& path) {
    if (path.empty()) return;
    std::error_code failure;
    std::vector<std::filesystem::path> missing;
    for (std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal();
         !std::filesystem::exists(folder, failure) && folder.has_relative_path();
         folder = folder.parent_path())
        missing.push_back(folder);
    std::reverse(missing.begin(), missing.end());
    for (const std::filesystem::path& folder : missing)
        made_.push_back(std::make_unique<TemporaryName>(
            folder.string(), [&] { return std::filesystem::create_directory(folder, failure); }));
    std::filesystem::create_directories(path, failure);
    if (failure) throw Error(path, "cannot create the folder: " + failure.message());
    if (::access(path.c_str(), W_OK | X_OK) != 0)
        throw Error(path, std::string("cannot write into the folder: ") + std::strerror(errno));
}

PreparedFolder::~PreparedFolder() {
    while (!made_.empty())
        made_.pop_back();
}

} // namespace gnomon
