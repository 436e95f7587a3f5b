#include "hierarchy/source/http_source.h"

#include "core/error.h"
#include "core/stopwatch.h"

#include <algorithm>
#include <utility>

namespace gnomon::hierarchy {

namespace {

constexpr std::uint64_t kHeadBytes = 1024;                     // for the header; in most models it contains no page
constexpr std::uint64_t kTailBytes = std::uint64_t{64} << 10U; // for the tables of a small model
constexpr std::chrono::milliseconds kFirstPause{100};
constexpr std::chrono::milliseconds kLongestPause{3000};
constexpr std::chrono::milliseconds kMaxOpenTime{1000}; // short at the start, because the server may not exist
// The min number of bytes of a server's answer that counts as progress, unless fewer bytes remain. A server that sends
// single bytes thus makes no progress.
constexpr std::size_t kMinPartBytes = std::size_t{16} << 10U;

/// Returns `address` without user name, password, query and fragment, so that messages do not contain secrets.
std::string toldAddress(const std::string& address) {
    const std::size_t scheme = address.find("//");
    const std::size_t host = scheme == std::string::npos ? 0 : scheme + 2;
    const std::size_t path = std::min(address.find_first_of("/?#", host), address.size());
    const std::size_t user = address.substr(0, path).rfind('@');
    const std::size_t begin = user == std::string::npos || user < host ? host : user + 1;
    const std::size_t end = std::min(address.find_first_of("?#", path), address.size());
    return address.substr(0, host) + address.substr(begin, end - begin);
}

[[noreturn]] void throwFailure(const std::string& where, const RangeFailure& failure) {
    if (failure.expected.empty()) throw Error(where, failure.what);
    throw Error(where, failure.what, failure.expected, failure.found);
}

} // namespace

HttpSource::HttpSource(const std::string& address, const Access& access)
    : name_(toldAddress(address)), access_(access), connections_(address, access) {
    open(std::min(access.retryTime, kMaxOpenTime));
    // Without a tag and a date from the server, the cache could not recognise outdated ranges. The ranges are
    // therefore not cached.
    if (identity_.tag.empty() && identity_.modified.empty()) return;
    const std::string folder = access.cacheFolder.empty() ? defaultCacheFolder() : access.cacheFolder;
    if (access.cache.count > 0 && !folder.empty()) cache_.emplace(folder, access.cache, address + "\n" + stamp());
}

void HttpSource::open(std::chrono::milliseconds retryTime) {
    head_.resize(kHeadBytes);
    std::chrono::milliseconds pause = kFirstPause;
    for (const Stopwatch watch;; pause = std::min(2 * pause, kLongestPause)) {
        const RangeAnswer answer = connections_.get(0, head_, nullptr);
        const std::uint64_t whole = std::min<std::uint64_t>(kHeadBytes, answer.identity.size);
        if (!answer.failure && answer.received == whole) {
            head_.resize(answer.received);
            identity_ = answer.identity;
            return;
        }
        const RangeFailure failure = answer.failure.value_or(RangeFailure{
            Refusal::Lasting,
            "the server sends less than it has",
            std::to_string(whole) + " bytes",
            std::to_string(answer.received)});
        const bool mayPass =
            failure.refusal == Refusal::Passing && watch.elapsed().count < static_cast<double>(retryTime.count());
        if (!mayPass || !waitFor(pause)) throwFailure(name_, failure);
    }
}

std::string HttpSource::stamp() const {
    return std::to_string(identity_.size) + " bytes, " + identity_.tag + ", " + identity_.modified;
}

void HttpSource::stop() const {
    connections_.stop();
    const std::lock_guard lock(mutex_);
    stopped_.notify_all();
}

/// Waits for the duration `pause`. Returns false if `stop` was called meanwhile.
bool HttpSource::waitFor(std::chrono::milliseconds pause) const {
    std::unique_lock lock(mutex_);
    return !stopped_.wait_for(lock, pause, [this] { return connections_.isStopped(); });
}

/// Requests the bytes from `offset` into `out`. After a failure it retries. The pauses grow as long as there is no
/// progress.
void HttpSource::fetch(std::uint64_t offset, std::span<std::byte> out) const {
    std::size_t done = 0;
    std::chrono::milliseconds pause = kFirstPause;
    Stopwatch sinceProgress;
    while (done < out.size()) {
        const std::size_t left = out.size() - done;
        RangeAnswer answer = connections_.get(offset + done, out.subspan(done), &identity_);
        const bool hasProgressed = answer.received >= std::min(left, kMinPartBytes);
        done += answer.received;
        if (done == out.size()) break; // all bytes are there, so a failure does not matter
        const std::string where = atByte(name_, offset + done);
        if (!answer.failure && !hasProgressed)
            answer.failure = {
                Refusal::Lasting,
                "the server sends ranges in crumbs",
                std::to_string(left) + " bytes",
                std::to_string(answer.received)};
        if (hasProgressed) {
            sinceProgress = {};
            pause = kFirstPause;
        }
        if (!answer.failure) continue;
        const Refusal refusal = answer.failure->refusal;
        if (refusal == Refusal::Changed) fate_ = Fate::Changed;
        if (refusal == Refusal::Vanished) fate_ = Fate::Gone;
        const bool mayPass = refusal == Refusal::Passing &&
                             sinceProgress.elapsed().count < static_cast<double>(access_.retryTime.count());
        if (!mayPass || !waitFor(pause)) throwFailure(where, *answer.failure);
        pause = std::min(2 * pause, kLongestPause);
    }
    fate_ = Fate::Same;
}

void HttpSource::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    if (offset > identity_.size || out.size() > identity_.size - offset)
        throw Error(
            atByte(name_, offset),
            "the file ends too early",
            std::to_string(out.size()) + " more bytes",
            std::to_string(identity_.size - std::min(identity_.size, offset)));
    if (offset + out.size() <= head_.size())
        std::copy_n(head_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
    else if (offset >= tailOffset())
        readTail(offset, out);
    else
        readKept(offset, out);
}

bool HttpSource::readAnew(std::uint64_t offset, std::span<std::byte> out) const {
    if (offset >= tailOffset()) {
        std::vector<std::byte> tail(identity_.size - tailOffset());
        fetchKept(tailOffset(), tail);
        takeTail(std::move(tail), offset, out);
    } else {
        fetchKept(offset, out);
    }
    return true;
}

std::uint64_t HttpSource::tailOffset() const {
    return identity_.size - std::min(identity_.size, kTailBytes);
}

void HttpSource::readTail(std::uint64_t offset, std::span<std::byte> out) const {
    {
        const std::lock_guard lock(mutex_);
        if (!tail_.empty()) return copyTail(offset, out);
    }
    std::vector<std::byte> tail(identity_.size - tailOffset());
    readKept(tailOffset(), tail);
    takeTail(std::move(tail), offset, out);
}

void HttpSource::takeTail(std::vector<std::byte> tail, std::uint64_t offset, std::span<std::byte> out) const {
    const std::lock_guard lock(mutex_);
    tail_ = std::move(tail);
    copyTail(offset, out);
}

void HttpSource::copyTail(std::uint64_t offset, std::span<std::byte> out) const {
    std::copy_n(tail_.begin() + static_cast<std::ptrdiff_t>(offset - tailOffset()), out.size(), out.begin());
}

void HttpSource::fetchKept(std::uint64_t offset, std::span<std::byte> out) const {
    fetch(offset, out);
    if (cache_) cache_->put(offset, out);
}

void HttpSource::readKept(std::uint64_t offset, std::span<std::byte> out) const {
    if (!cache_ || !cache_->get(offset, out)) fetchKept(offset, out);
}

} // namespace gnomon::hierarchy
