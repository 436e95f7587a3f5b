#include "preprocess/scratch/scratch_file.h"

#include "core/check.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <vector>

namespace gnomon::scratch {

namespace {

class DiskScratch final : public ScratchFile {
public:
    DiskScratch(const std::string& path, TemporarySpace& space) : ScratchFile(space), file_(path, File::Mode::Create) {}

private:
    void load(std::uint64_t offset, std::span<std::byte> out) const override { file_.readAt(offset, out); }

    void store(std::uint64_t offset, std::span<const std::byte> bytes) override { file_.writeAt(offset, bytes); }

    void forget(std::uint64_t offset, std::uint64_t bytes) override { file_.release(offset, bytes); }

    File file_;
};

class MemoryScratch final : public ScratchFile {
public:
    explicit MemoryScratch(TemporarySpace& space) : ScratchFile(space) {}

private:
    void load(std::uint64_t offset, std::span<std::byte> out) const override {
        const std::shared_lock lock(mutex_);
        const auto after = pieces_.upper_bound(offset);
        GNOMON_CHECK(after != pieces_.begin());
        const auto& [begin, bytes] = *std::prev(after);
        GNOMON_CHECK_OP(offset - begin + out.size(), <=, bytes.size());
        std::memcpy(out.data(), bytes.data() + (offset - begin), out.size());
    }

    void store(std::uint64_t offset, std::span<const std::byte> bytes) override {
        std::vector<std::byte> copy(bytes.begin(), bytes.end());
        const std::scoped_lock lock(mutex_);
        pieces_.emplace(offset, std::move(copy));
    }

    void forget(std::uint64_t offset, std::uint64_t /*bytes*/) override {
        const std::scoped_lock lock(mutex_);
        pieces_.erase(offset);
    }

    mutable std::shared_mutex mutex_;
    std::map<std::uint64_t, std::vector<std::byte>> pieces_;
};

} // namespace

void TemporarySpace::take(std::uint64_t bytes) {
    written_ += bytes;
    takeOfOthers(bytes);
}

void TemporarySpace::takeOfOthers(std::uint64_t bytes) {
    const auto more = static_cast<std::int64_t>(bytes);
    const auto now = static_cast<std::uint64_t>(std::max<std::int64_t>(bytes_ += more, 0));
    std::uint64_t peak = peak_;
    while (peak < now && !peak_.compare_exchange_weak(peak, now)) {
    }
    progress_.temporarySpace(now);
}

void TemporarySpace::pace(std::uint64_t bytes) {
    if (bytesPerSecond_ == 0) return;
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> takes(static_cast<double>(bytes) / static_cast<double>(bytesPerSecond_));
    Clock::time_point end;
    {
        const std::scoped_lock lock(paceMutex_);
        free_ = std::max(free_, Clock::now()) + std::chrono::duration_cast<Clock::duration>(takes);
        end = free_;
    }
    std::this_thread::sleep_until(end);
}

void TemporarySpace::giveBack(std::uint64_t bytes) {
    bytes_ -= static_cast<std::int64_t>(bytes);
    progress_.temporarySpace(this->bytes());
}

std::uint64_t ScratchFile::append(std::span<const std::byte> bytes) {
    if (bytes.empty()) return end_;
    space_.take(bytes.size());
    space_.pace(bytes.size());
    const std::uint64_t offset = end_.fetch_add(bytes.size());
    store(offset, bytes);
    return offset;
}

void ScratchFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    if (loadCopy(offset, out)) return;
    space_.countRead(out.size());
    space_.pace(out.size());
    load(offset, out);
    keepCopy(offset, out);
}

void ScratchFile::release(std::uint64_t offset, std::uint64_t bytes) {
    if (bytes == 0) return;
    forget(offset, bytes);
    space_.giveBack(bytes);
}

std::unique_ptr<ScratchFile> scratchOnDisk(const std::string& path, TemporarySpace& space) {
    return std::make_unique<DiskScratch>(path, space);
}

std::unique_ptr<ScratchFile> scratchInMemory(TemporarySpace& space) {
    return std::make_unique<MemoryScratch>(space);
}

} // namespace gnomon::scratch
