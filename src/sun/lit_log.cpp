#include "sun/lit_log.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <utility>

namespace gnomon::sun {

namespace {

using Words = std::vector<std::uint64_t>;

constexpr std::uint64_t kMagic = 0x31534B494C4E47FFU; // no text file begins with these bytes
constexpr std::size_t kHeadWords = 2;                 // number of 64-bit words: magic number, length of the key
constexpr std::uint64_t kMaxKey = 65536;
constexpr const char* kSuffix = ".steps";

std::span<const std::byte> bytesOf(const Words& words) {
    return std::as_bytes(std::span(words));
}

std::uint64_t sumOf(const Words& words, std::size_t count, std::uint64_t seed) {
    std::uint64_t sum = mix64(seed);
    for (std::size_t i = 0; i < count; ++i)
        sum = mix64(sum ^ words[i]);
    return sum;
}

/// Returns true if the present bytes of the file equal the beginning of a log.
bool isLog(const std::string& path) {
    std::uint64_t magic = 0;
    const std::size_t found = File(path, File::Mode::Read).readSomeAt(0, std::as_writable_bytes(std::span(&magic, 1)));
    return found < sizeof(magic) || magic == kMagic;
}

std::size_t wordsOf(std::size_t receivers) {
    return (receivers + 63) / 64;
}

} // namespace

LitLog::LitLog(File file, const std::string& key, std::size_t receivers)
    : receivers_(receivers),
      firstRecord_(kHeadWords * sizeof(std::uint64_t) + key.size()),
      recordBytes_((wordsOf(receivers) + 1) * sizeof(std::uint64_t)),
      file_(std::move(file)) {}

LitLog::LitLog(const std::string& path, const std::string& key, std::size_t receivers, bool isResumed)
    : LitLog(File(path, File::Mode::Lock), key, receivers) {
    if (!file_.tryLock()) throw Error(path, "another process writes this log; wait for its end");
    if (const std::uintmax_t names = std::filesystem::hard_link_count(path); names > 1)
        throw Error(
            path,
            "cannot overwrite a file with several hard links; choose another name",
            "1 link",
            std::to_string(names));
    if (hasLog() && isResumed) {
        requireKey(key);
        return;
    }
    file_.resize(0);
    const Words head = {kMagic, key.size()};
    file_.writeAt(0, bytesOf(head));
    file_.writeAt(kHeadWords * sizeof(std::uint64_t), std::as_bytes(std::span(key)));
}

std::optional<LitLog> LitLog::ofAnother(const std::string& path, const std::string& key, std::size_t receivers) {
    LitLog log(File(path, File::Mode::Read), key, receivers);
    if (!log.hasLog()) return std::nullopt;
    log.requireKey(key);
    return log;
}

/// Returns true if the header of the log file is complete. Throws Error if the file is not a log.
bool LitLog::hasLog() const {
    Words head(kHeadWords);
    const std::size_t found = file_.readSomeAt(0, std::as_writable_bytes(std::span(head)));
    if (found >= sizeof(std::uint64_t) && head[0] != kMagic)
        throw Error(file_.path(), "this file is not a log of sun hours, and is not overwritten");
    const std::uint64_t headBytes = kHeadWords * sizeof(std::uint64_t);
    // A shorter file belongs to a process that was killed before it wrote the whole key.
    return found == headBytes && file_.size() - headBytes >= head[1];
}

void LitLog::requireKey(const std::string& key) const {
    std::uint64_t length = 0;
    file_.readAt(sizeof(kMagic), std::as_writable_bytes(std::span(&length, 1)));
    std::string before(std::min(length, kMaxKey), ' ');
    before.resize(file_.readSomeAt(kHeadWords * sizeof(std::uint64_t), std::as_writable_bytes(std::span(before))));
    if (before != key)
        throw Error(
            file_.path(),
            "cannot resume: this log is of another model, other options or other times; delete it to start again");
}

void LitLog::put(std::size_t light, const std::vector<std::uint8_t>& isLit) {
    Words record(wordsOf(receivers_) + 1);
    for (std::size_t i = 0; i < receivers_; ++i)
        record[i / 64] |= std::uint64_t{isLit[i] != 0} << i % 64;
    record.back() = sumOf(record, record.size() - 1, light);
    file_.writeAt(offsetOf(light), bytesOf(record));
}

bool LitLog::read(std::size_t light, std::vector<std::uint8_t>& isLit) const {
    Words record(recordBytes_ / sizeof(std::uint64_t));
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(record));
    if (file_.readSomeAt(offsetOf(light), bytes) < bytes.size()) return false;
    if (record.back() != sumOf(record, record.size() - 1, light)) return false;
    isLit.resize(receivers_);
    for (std::size_t i = 0; i < receivers_; ++i)
        isLit[i] = static_cast<std::uint8_t>(record[i / 64] >> i % 64 & 1U);
    return true;
}

LitLogs::LitLogs(std::string stem, std::string key, std::size_t receivers, const LightShare& share, bool isResumed)
    : stem_(std::move(stem)),
      key_(std::move(key)),
      receivers_(receivers),
      rank_(share.rank),
      own_(pathOf(rank_), key_, receivers, isResumed) {
    if (isResumed)
        openOthers();
    else if (rank_ == 0)
        for (const std::string& path : otherPaths(share.ranks))
            std::filesystem::remove(path);
}

std::string LitLogs::pathOf(std::uint32_t rank) const {
    return stem_ + (rank == 0 ? "" : "." + std::to_string(rank)) + kSuffix;
}

std::vector<std::string> LitLogs::otherPaths(std::uint32_t firstRank) const {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(stem_).parent_path();
    const std::string begin = fs::path(stem_).filename().string() + ".";
    std::vector<std::string> paths;
    if (firstRank == 0 && rank_ != 0 && fs::exists(pathOf(0))) paths.push_back(pathOf(0));
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder)) {
        const std::string name = entry.path().filename().string();
        std::uint32_t rank = 0;
        if (name.starts_with(begin)) std::from_chars(name.data() + begin.size(), name.data() + name.size(), rank);
        if (rank == 0 || rank < firstRank || rank == rank_) continue;
        const std::string path = pathOf(rank);
        if (fs::path(path).filename() == name && entry.is_regular_file() && isLog(path)) paths.push_back(path);
    }
    return paths;
}

bool LitLogs::read(std::size_t light, std::vector<std::uint8_t>& isLit) const {
    return own_.read(light, isLit) ||
           std::any_of(others_.begin(), others_.end(), [&](const LitLog& other) { return other.read(light, isLit); });
}

void LitLogs::openOthers() {
    others_.clear();
    for (const std::string& path : otherPaths(0))
        if (std::optional<LitLog> other = LitLog::ofAnother(path, key_, receivers_))
            others_.push_back(std::move(*other));
}

void LitLogs::remove() const {
    for (const std::string& path : otherPaths(0))
        std::filesystem::remove(path);
    std::filesystem::remove(pathOf(rank_));
}

} // namespace gnomon::sun
