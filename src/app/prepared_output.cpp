#include "app/prepared_output.h"

#include "core/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace gnomon::app {

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
    for (std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal();
         !std::filesystem::exists(folder, failure) && folder.has_relative_path();
         folder = folder.parent_path())
        made_.push_back(folder);
    std::filesystem::create_directories(path, failure);
    if (failure) throw Error(path, "cannot make the folder: " + failure.message());
    if (::access(path.c_str(), W_OK | X_OK) != 0)
        throw Error(path, std::string("cannot write into the folder: ") + std::strerror(errno));
}

PreparedFolder::~PreparedFolder() {
    std::error_code failure; // of one that holds something, which stays
    for (const std::filesystem::path& folder : made_)
        std::filesystem::remove(folder, failure);
}

} // namespace gnomon::app
