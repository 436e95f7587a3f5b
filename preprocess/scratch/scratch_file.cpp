#include "preprocess/scratch/scratch_file.h"

#include "core/check.h"
#include "hierarchy/file_layout.h"
#include "preprocess/scratch/damage_error.h"

#include <algorithm>
#include <array>
#include <cstdio>
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
    void load(std::uint64_t offset, std::span<std::byte> out) const override { loadFrom(file_, offset, out); }

    void store(std::uint64_t offset, std::span<const std::byte> bytes) override { file_.writeAt(offset, bytes); }

    void forget(std::uint64_t offset, std::uint64_t bytes) override { file_.release(offset, bytes); }

    std::string placeText(std::uint64_t offset) const override { return atByte(file_.path(), offset); }

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

    std::string placeText(std::uint64_t offset) const override { return atByte("temporary data in memory", offset); }

    mutable std::shared_mutex mutex_;
    std::map<std::uint64_t, std::vector<std::byte>> pieces_;
};

std::string checksumText(std::uint64_t checksum) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "checksum %016llx", static_cast<unsigned long long>(checksum));
    return digits.data();
}

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

Block ScratchFile::append(std::span<const std::byte> bytes) {
    if (bytes.empty()) return {end_, 0, 0};
    space_.take(bytes.size());
    space_.pace(bytes.size());
    const Block block{end_.fetch_add(bytes.size()), bytes.size(), hierarchy::checksum64(bytes)};
    store(block.offset, bytes);
    return block;
}

void ScratchFile::read(const Block& block, std::span<std::byte> out) const {
    GNOMON_CHECK_OP(out.size(), ==, block.bytes);
    if (out.empty()) return;
    space_.countRead(out.size());
    space_.pace(out.size());
    load(block.offset, out);
    if (const std::uint64_t found = hierarchy::checksum64(out); found != block.checksum)
        throw DamageError(
            placeText(block.offset),
            std::to_string(block.bytes) + " bytes of temporary data are damaged",
            checksumText(block.checksum),
            checksumText(found));
}

std::vector<std::byte> ScratchFile::read(std::span<const Block> blocks) const {
    std::size_t size = 0;
    for (const Block& block : blocks)
        size += block.bytes;
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    for (const Block& block : blocks) {
        read(block, std::span(bytes).subspan(done, block.bytes));
        done += block.bytes;
    }
    return bytes;
}

void ScratchFile::release(const Block& block) {
    if (block.bytes == 0) return;
    forget(block.offset, block.bytes);
    space_.giveBack(block.bytes);
}

void ScratchFile::loadFrom(const File& file, std::uint64_t offset, std::span<std::byte> out) {
    const std::size_t got = file.readSomeAt(offset, out);
    if (got < out.size())
        throw DamageError(
            atByte(file.path(), offset + got),
            "temporary data are cut off",
            std::to_string(out.size() - got) + " more bytes",
            "the end of the file");
}

std::unique_ptr<ScratchFile> scratchOnDisk(const std::string& path, TemporarySpace& space) {
    return std::make_unique<DiskScratch>(path, space);
}

std::unique_ptr<ScratchFile> scratchInMemory(TemporarySpace& space) {
    return std::make_unique<MemoryScratch>(space);
}

} // namespace gnomon::scratch
