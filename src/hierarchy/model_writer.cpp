#include "hierarchy/model_writer.h"

#include "core/check.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <utility>

#include <xxhash.h>

namespace gnomon::hierarchy {

EncodedPage encodePage(const Page& page, const PageFields& fields) {
    GNOMON_CHECK_OP(pageFault(page).value_or("no fault"), ==, "no fault");
    EncodedPage encoded;
    encoded.info = describePage(page);
    encoded.bytes = encodePageBytes(page, fields);
    encoded.info.storedBytes = static_cast<std::uint32_t>(encoded.bytes.size());
    encoded.info.checksum = checksum64(encoded.bytes);
    return encoded;
}

struct ModelWriter::State {
    explicit State(const std::string& path) : output(path), hash(XXH3_createState(), XXH3_freeState) {
        if (!hash) throw std::bad_alloc();
        XXH3_128bits_reset(hash.get());
    }

    /// Appends `bytes` to the model file. All bytes after the header pass through this function in file order, except
    /// the pages that other processes write.
    void write(std::span<const std::byte> bytes) {
        output.file().writeAt(offset, bytes);
        XXH3_128bits_update(hash.get(), bytes.data(), bytes.size());
        offset += bytes.size();
    }

    void enter(PageInfo info) {
        GNOMON_CHECK(pages.empty() || info.level <= pages.back().level);
        info.offset = offset;
        pages.push_back(std::move(info));
    }

    /// Adds the pages that other processes have written to the content hash. The file is opened again for this, because
    /// network file systems guarantee only to a new file descriptor that such bytes are visible.
    void hashReserved() {
        constexpr std::uint64_t kBlock = std::uint64_t{1} << 20U;
        const File file(output.temporaryPath().value(), File::Mode::Read, output.file().path());
        std::vector<std::byte> block;
        for (std::uint64_t at = kHeaderBytes; at < offset; at += block.size()) {
            block.resize(std::min(kBlock, offset - at));
            file.readAt(at, block);
            XXH3_128bits_update(hash.get(), block.data(), block.size());
            bytesRead += block.size();
        }
    }

    TablePlace writeTable(std::span<const std::byte> bytes) {
        const TablePlace place{offset, bytes.size(), checksum64(bytes)};
        write(bytes);
        return place;
    }

    AtomicFile output;
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> hash;
    std::uint64_t offset = kHeaderBytes;
    std::vector<PageInfo> pages;
    bool hasReserved = false;
    std::uint64_t bytesRead = 0;
};

ModelWriter::ModelWriter(const std::string& path) : state_(std::make_unique<State>(path)) {}

ModelWriter::~ModelWriter() = default;

std::uint32_t ModelWriter::append(const EncodedPage& page) {
    GNOMON_CHECK(!state_->hasReserved);
    state_->enter(page.info);
    state_->write(page.bytes);
    return static_cast<std::uint32_t>(state_->pages.size() - 1);
}

std::uint64_t ModelWriter::reserve(const PageInfo& page) {
    GNOMON_CHECK(state_->hasReserved || state_->pages.empty());
    state_->hasReserved = true;
    state_->enter(page);
    return std::exchange(state_->offset, state_->offset + page.storedBytes);
}

std::optional<std::string> ModelWriter::unfinishedPath() const {
    return state_->output.temporaryPath();
}

std::string ModelWriter::finish(const ModelSummary& summary) {
    if (state_->hasReserved) state_->hashReserved();
    Footer footer;
    footer.pageTable = state_->writeTable(encodePageTable(state_->pages));
    footer.summary = state_->writeTable(encodeSummary(summary));
    footer.pageCount = state_->pages.size();
    footer.fileBytes = state_->offset + kFooterBytes;
    state_->write(encodeFooter(footer));
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_->hash.get()));
    ContentHash hash{};
    std::memcpy(hash.data(), canonical.digest, hash.size());
    state_->output.file().writeAt(0, encodeHeader(flagsOf(summary), hash));
    state_->output.commit();
    return hexText(hash);
}

std::uint64_t ModelWriter::bytesWritten() const {
    return state_->offset;
}

std::uint64_t ModelWriter::bytesRead() const {
    return state_->bytesRead;
}

} // namespace gnomon::hierarchy
