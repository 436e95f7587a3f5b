#include "storage/range_cache.h"

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

namespace gnomon::storage {

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

/// A file of the cache.
struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes = 0;
    fs::path path;
};

std::vector<Kept> keptIn(const std::string& folder) {
    std::vector<Kept> result;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone; // another process makes room, too
        if (!it->is_regular_file(gone)) continue;
        Kept kept{it->last_write_time(gone), 0, it->path()};
        if (!gone) kept.bytes = it->file_size(gone);
        if (!gone) result.push_back(std::move(kept));
    }
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
    if (fs::create_directories(place_, error)) fs::permissions(place_, fs::perms::owner_all, error);
    makeRoom(size);
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
        return; // the disk is full, or the folder is not ours: then there is no cache
    }
}

/// Counts `bytes` as kept, and where that is beyond the cap removes what was not used for the longest time. Others'
/// files are counted now and then.
void RangeCache::makeRoom(std::uint64_t bytes) const {
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
    const std::uint64_t least = cap_.count - cap_.count / 8; // not one by one
    std::error_code error;
    for (const Kept& file : kept) {
        if (total_ <= std::max(least, bytes)) return;
        fs::remove(file.path, error);
        total_ -= file.bytes;
    }
}

std::string defaultCacheFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME"); // NOLINT(concurrency-mt-unsafe): nobody writes it
    if (cache != nullptr && *cache == '/') return cache + std::string("/gnomon/ranges");
    const char* home = std::getenv("HOME"); // NOLINT(concurrency-mt-unsafe): likewise
    if (home != nullptr && *home == '/') return home + std::string("/.cache/gnomon/ranges");
    return {};
}

} // namespace gnomon::storage
