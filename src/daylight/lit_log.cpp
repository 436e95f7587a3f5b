#include "daylight/lit_log.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace gnomon::daylight {

namespace {

using Words = std::vector<std::uint64_t>;

constexpr std::uint64_t kMagic = 0x31534B494C4E47FFU; // no text begins so
constexpr std::size_t kHeadWords = 2;                 // magic, length of the key
constexpr std::uint64_t kMostKey = 65536;

std::span<const std::byte> bytesOf(const Words& words) {
    return std::as_bytes(std::span(words));
}

std::uint64_t sumOf(const Words& words, std::size_t count, std::uint64_t seed) {
    std::uint64_t sum = mix64(seed);
    for (std::size_t i = 0; i < count; ++i)
        sum = mix64(sum ^ words[i]);
    return sum;
}

std::size_t wordsOf(std::size_t receivers) {
    return (receivers + 63) / 64;
}

} // namespace

LitLog::LitLog(std::string path, const std::string& key, std::size_t receivers, std::size_t lights, bool isResumed)
    : path_(std::move(path)), receivers_(receivers), file_(path_, File::Mode::Lock) {
    if (!file_.tryLock()) throw Error(path_, "another process is at work on it");
    if (const std::uintmax_t names = std::filesystem::hard_link_count(path_); names > 1)
        throw Error(
            path_,
            "cannot be changed, since other names (hard links) lead to the same file",
            "one name",
            std::to_string(names));
    firstRecord_ = kHeadWords * sizeof(std::uint64_t) + key.size();
    recordBytes_ = (wordsOf(receivers) + 1) * sizeof(std::uint64_t);
    if (hasLog() && isResumed) {
        resume(key, lights);
        return;
    }
    file_.resize(0);
    const Words head = {kMagic, key.size()};
    file_.writeAt(0, bytesOf(head));
    file_.writeAt(kHeadWords * sizeof(std::uint64_t), std::as_bytes(std::span(key)));
}

/// Whether there is a log. Throws Error where there is something else.
bool LitLog::hasLog() const {
    Words head(kHeadWords);
    const std::size_t found = file_.readSomeAt(0, std::as_writable_bytes(std::span(head)));
    if (found >= sizeof(std::uint64_t) && head[0] != kMagic)
        throw Error(path_, "is no log of hours of sun, so it is left alone");
    const std::uint64_t headBytes = kHeadWords * sizeof(std::uint64_t);
    return found == headBytes && file_.size() - headBytes >= head[1]; // else a kill came before the key was there
}

/// Finds the whole records of the log that is there, of the first `lights` places. The file can be longer than all of
/// them, since a file of any size can be one hole.
void LitLog::resume(const std::string& key, std::size_t lights) {
    std::uint64_t length = 0;
    file_.readAt(sizeof(kMagic), std::as_writable_bytes(std::span(&length, 1)));
    std::string before(std::min(length, kMostKey), ' ');
    before.resize(file_.readSomeAt(kHeadWords * sizeof(std::uint64_t), std::as_writable_bytes(std::span(before))));
    if (before != key) throw Error(path_, "cannot resume, input or options changed", key, before);
    const std::uint64_t bytes = file_.size() - std::min(file_.size(), firstRecord_);
    for (std::size_t light = 0; light < std::min<std::uint64_t>(bytes / recordBytes_, lights); ++light)
        if (isWhole(light)) note(light);
    file_.resize(offsetOf(isThere_.size()));
}

void LitLog::note(std::size_t light) {
    if (light >= isThere_.size()) isThere_.resize(light + 1);
    if (!isThere_[light]) ++size_;
    isThere_[light] = true;
}

bool LitLog::isWhole(std::size_t light) const {
    Words record(recordBytes_ / sizeof(std::uint64_t));
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(record));
    if (file_.readSomeAt(offsetOf(light), bytes) < bytes.size()) return false;
    return record.back() == sumOf(record, record.size() - 1, light);
}

void LitLog::put(std::size_t light, const std::vector<std::uint8_t>& isLit) {
    Words record(wordsOf(receivers_) + 1);
    for (std::size_t i = 0; i < receivers_; ++i)
        record[i / 64] |= std::uint64_t{isLit[i] != 0} << i % 64;
    record.back() = sumOf(record, record.size() - 1, light);
    file_.writeAt(offsetOf(light), bytesOf(record));
    note(light);
}

void LitLog::read(std::size_t light, std::vector<std::uint8_t>& isLit) const {
    Words record(wordsOf(receivers_) + 1);
    file_.readAt(offsetOf(light), std::as_writable_bytes(std::span(record)));
    if (record.back() != sumOf(record, record.size() - 1, light)) throw Error(path_, "a record is damaged");
    isLit.resize(receivers_);
    for (std::size_t i = 0; i < receivers_; ++i)
        isLit[i] = static_cast<std::uint8_t>(record[i / 64] >> i % 64 & 1U);
}

void LitLog::remove() {
    std::filesystem::remove(path_);
}

} // namespace gnomon::daylight
