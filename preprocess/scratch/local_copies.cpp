#include "preprocess/scratch/local_copies.h"

#include "core/error.h"

#include <filesystem>

#include <unistd.h>

namespace gnomon::scratch {

namespace {

/// A new file whose name is taken away at once.
File namelessFile(const std::string& folder) {
    constexpr unsigned kOwnersOnly = 0600;
    for (int attempt = 0;; ++attempt) {
        const std::string name = "gnomon." + std::to_string(::getpid()) + "." + std::to_string(attempt) + ".copies";
        const std::string path = (std::filesystem::path(folder) / name).string();
        if (std::optional<File> file = File::createdNew(path, kOwnersOnly, path)) {
            std::filesystem::remove(path);
            return std::move(*file);
        }
    }
}

} // namespace

LocalCopies::LocalCopies(const std::string& folder) : file_(namelessFile(folder)) {}

bool LocalCopies::read(std::uint64_t place, std::span<std::byte> out) const {
    Copy copy;
    {
        const std::scoped_lock lock(mutex_);
        const auto found = copies_.find(place);
        if (found == copies_.end() || found->second.bytes != out.size()) return false;
        copy = found->second;
    }
    file_.readAt(copy.offset, out);
    return true;
}

void LocalCopies::keep(std::uint64_t place, std::span<const std::byte> bytes) {
    constexpr std::size_t kLeast = 256; // less is not worth its row in the table
    Copy copy{0, bytes.size()};
    {
        const std::scoped_lock lock(mutex_);
        if (isFull_ || bytes.size() < kLeast) return;
        copy.offset = end_;
        end_ += copy.bytes;
    }
    bool isKept = true;
    try {
        file_.writeAt(copy.offset, bytes);
    } catch (const Error&) {
        isKept = false; // the original is still there
    }
    const std::scoped_lock lock(mutex_);
    if (isKept)
        copies_[place] = copy;
    else
        isFull_ = true;
}

void LocalCopies::clear() {
    const std::scoped_lock lock(mutex_);
    if (end_ == 0) return;
    copies_.clear();
    file_.resize(0);
    end_ = 0;
    isFull_ = false;
}

} // namespace gnomon::scratch
