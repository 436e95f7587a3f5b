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

void prepareFolder(const std::string& path) {
    if (path.empty()) return;
    std::error_code failure;
    std::filesystem::create_directories(path, failure);
    if (failure) throw Error(path, "cannot make the folder: " + failure.message());
    if (::access(path.c_str(), W_OK | X_OK) != 0)
        throw Error(path, std::string("cannot write into the folder: ") + std::strerror(errno));
}

} // namespace gnomon::app
