// A whole .gnm whose checksums are mended: tables, then pages.
#include "core/error.h"
#include "harness.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/model_file.h"
#include "hierarchy/validation.h"
#include "resealed.h"

#include <cstdlib>
#include <cstring>

namespace gnomon::fuzz {
namespace {

/// Bytes in memory.
class MemorySource final : public hierarchy::Source {
public:
    explicit MemorySource(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

    const std::string& name() const override { return name_; }

    std::uint64_t size() const override { return bytes_.size(); }

    void readAt(std::uint64_t offset, std::span<std::byte> out) const override {
        if (offset > bytes_.size() || out.size() > bytes_.size() - offset) throw Error(name_, "ends before");
        if (!out.empty()) std::memcpy(out.data(), bytes_.data() + offset, out.size());
    }

    bool readAnew(std::uint64_t /*offset*/, std::span<std::byte> /*out*/) const override { return false; }

    hierarchy::Fate fate() const override { return hierarchy::Fate::Same; }

    std::string stamp() const override { return {}; }

    unsigned parallelReads() const override { return 1; }

    bool isRemote() const override { return false; }

    void stop() const override {}

private:
    std::string name_ = "input.gnm";
    std::vector<std::byte> bytes_;
};

constexpr std::uint32_t kMaxPages = 16; // of a file: the others differ by their bytes alone

/// Aborts unless what was read of the summary is written as bytes that say the same.
void storeAndRead(const hierarchy::ModelSummary& summary) {
    try {
        const std::vector<std::byte> stored = hierarchy::encodeSummary(summary);
        if (hierarchy::encodeSummary(hierarchy::decodeSummary(stored)) != stored) std::abort();
    } catch (const hierarchy::Damage&) {
        std::abort();
    }
}

} // namespace
} // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    try {
        const hierarchy::ModelFile model(
            std::make_unique<fuzz::MemorySource>(fuzz::resealed(std::as_bytes(std::span(data, size)))), mebibytes(16));
        static_cast<void>(hierarchy::drawingFault(model.pages(), model.summary().grid));
        static_cast<void>(model.computedContentHash());
        static_cast<void>(hierarchy::encodePageTable(model.pages()));
        fuzz::storeAndRead(model.summary());
        const auto pages = static_cast<std::uint32_t>(model.pages().size());
        for (std::uint32_t page = 0; page < std::min(pages, fuzz::kMaxPages); ++page) {
            try {
                hierarchy::PageFields fields;
                static_cast<void>(model.readPage(page, fields));
            } catch (const hierarchy::PageDamage&) { // the others may be sound
            }
        }
    } catch (const Error&) { // refused in words
    }
    return 0;
}
