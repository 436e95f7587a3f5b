#include "hierarchy/source/range_cache.h"

#include "core/error.h"
#include "core/file.h"
#include "core/formatted.h"
#include "core/temporary_name.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include <unistd.h>
#include <xxhash.h>

namespace gnomon::hierarchy {

namespace {

namespace fs = std::filesystem;

using Sum = std::array<std::byte, sizeof(XXH128_canonical_t)>;

Sum sumOf(std::span<const std::byte> bytes) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
    Sum sum{};
    std::copy_n(reinterpret_cast<const std::byte*>(canonical.digest), sum.size(), sum.begin());
    return sum;
}

std::string digitsOf(const Sum& sum) {
    std::string text;
    for (const std::byte byte : sum)
        text += formatted("%02x", std::to_integer<unsigned>(byte));
    return text;
}

/// A file in the cache folder.
struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes = 0;
    fs::path path;
};

bool isFolder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(fs::symlink_status(path, error));
}

/// Returns true if `name` can be the name of a content's folder in the cache: the hexadecimal digits of a hash.
bool isNameOfFolder(const std::string& name) {
    return name.size() == 2 * sizeof(Sum) && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Returns true if `name` can be the name of a cache file: "OFFSET-SIZE", or "OFFSET-SIZE.PROCESS.NUMBER.partial".
bool isNameOfFile(std::string_view name) {
    const auto takeDigits = [&name] {
        const std::size_t end = std::min(name.find_first_not_of("0123456789"), name.size());
        name.remove_prefix(end);
        return end > 0;
    };
    const auto take = [&name](std::string_view start) {
        const bool isThere = name.starts_with(start);
        if (isThere) name.remove_prefix(start.size());
        return isThere;
    };
    if (!takeDigits() || !take("-") || !takeDigits()) return false;
    return name.empty() || (take(".") && takeDigits() && take(".") && takeDigits() && name == ".partial");
}

/// Calls `use(entry)` for each entry of `folder`. Stops without an error if the folder cannot be read.
template <class Use>
void forEachEntry(const fs::path& folder, const Use& use) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        use(*it);
}

/// Returns all cache files in `folder`. Skips files with other names, and does not follow links.
std::vector<Kept> keptIn(const std::string& folder) {
    std::vector<Kept> result;
    const auto add = [&result](const fs::directory_entry& file) {
        std::error_code gone; // set if another process deletes the file at the same time
        if (!isNameOfFile(file.path().filename().string())) return;
        if (!fs::is_regular_file(file.symlink_status(gone))) return;
        Kept kept{file.last_write_time(gone), 0, file.path()};
        if (!gone) kept.bytes = file.file_size(gone);
        if (!gone) result.push_back(std::move(kept));
    };
    if (!isFolder(folder)) return result;
    forEachEntry(folder, [&](const fs::directory_entry& place) {
        if (isNameOfFolder(place.path().filename().string()) && isFolder(place.path())) forEachEntry(place.path(), add);
    });
    return result;
}

} // namespace

RangeCache::RangeCache(const std::string& folder, Bytes cap, const std::string& content)
    : folder_(folder), place_(folder + "/" + digitsOf(sumOf(std::as_bytes(std::span(content))))), cap_(cap) {}

std::string RangeCache::pathOf(std::uint64_t offset, std::uint64_t size) const {
    return place_ + "/" + std::to_string(offset) + "-" + std::to_string(size);
}

bool RangeCache::get(std::uint64_t offset, std::span<std::byte> out) const {
    const std::string path = pathOf(offset, out.size());
    std::error_code error;
    if (fs::file_size(path, error) != sizeof(Sum) + out.size() || error) return false;
    try {
        const File file(path, File::Mode::Read);
        Sum sum{};
        file.readAt(0, sum);
        file.readAt(sizeof(Sum), out);
        if (sum != sumOf(out)) return false;
    } catch (const Error&) {
        return false;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);
    return true;
}

void RangeCache::put(std::uint64_t offset, std::span<const std::byte> bytes) const {
    static std::atomic<unsigned> number;
    const std::uint64_t size = sizeof(Sum) + bytes.size();
    if (size > cap_.count) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!isFolder(folder_)) return; // if it is a link, it could lead to a folder with other files
    if (fs::create_directory(place_, error)) fs::permissions(place_, fs::perms::owner_all, error);
    if (!isFolder(place_)) return;
    evictFor(size);
    try {
        const std::string path = pathOf(offset, bytes.size());
        const std::string partial = path + formatted(".%ld.%u.partial", static_cast<long>(::getpid()), ++number);
        std::optional<File> file;
        constexpr unsigned kOwnersOnly = 0600;
        TemporaryName temporary(partial, [&] {
            file = File::createdNew(partial, kOwnersOnly, partial);
            return file.has_value();
        });
        if (!file) return;
        file->writeAt(0, sumOf(bytes));
        file->writeAt(sizeof(Sum), bytes);
        temporary.keep([&] { return std::rename(partial.c_str(), path.c_str()) == 0; });
    } catch (const Error&) {
        return; // the disk is full or the folder is not writable; the cache is optional
    }
}

/// Adds `bytes` to the size of the cache. If the size exceeds the limit, evicts the least recently used files. From
/// time to time, the function counts the files again to include those of other processes.
void RangeCache::evictFor(std::uint64_t bytes) const {
    const std::lock_guard lock(mutex_);
    const bool isKnown = uncounted_ <= cap_.count / 8;
    total_ += bytes;
    if (isKnown) uncounted_ += bytes;
    if (isKnown && total_ <= cap_.count) return;
    std::vector<Kept> kept = keptIn(folder_);
    uncounted_ = bytes;
    total_ = bytes;
    for (const Kept& file : kept)
        total_ += file.bytes;
    if (total_ <= cap_.count) return;
    std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    // Frees an eighth of the cache at once, so that not each call has to evict files.
    const std::uint64_t targetBytes = cap_.count - cap_.count / 8;
    std::error_code error;
    for (const Kept& file : kept) {
        if (total_ <= std::max(targetBytes, bytes)) return;
        if (fs::remove(file.path, error)) total_ -= file.bytes;
    }
}

std::string defaultCacheFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME"); // NOLINT(concurrency-mt-unsafe): no thread changes it
    if (cache != nullptr && *cache == '/') return cache + std::string("/gnomon/ranges");
    const char* home = std::getenv("HOME"); // NOLINT(concurrency-mt-unsafe): no thread changes it
    if (home != nullptr && *home == '/') return home + std::string("/.cache/gnomon/ranges");
    return {};
}

} // namespace gnomon::hierarchy
