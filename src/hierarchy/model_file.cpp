#include "hierarchy/model_file.h"

#include "core/limit_error.h"
#include "hierarchy/file_layout.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/source/open_source.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <xxhash.h>

namespace gnomon::hierarchy {

namespace {

/// Reads `count` bytes from `offset`. The byte range must be inside the file.
std::vector<std::byte> readBytes(const hierarchy::Source& source, std::uint64_t offset, std::uint64_t count) {
    std::vector<std::byte> bytes(count);
    source.readAt(offset, bytes);
    return bytes;
}

/// Returns true if `bytes` have the checksum in `place`. If not, reads them again without caches and repeats the check.
bool isAsWritten(const hierarchy::Source& source, const TablePlace& place, std::span<std::byte> bytes) {
    const auto isRight = [&] { return checksum64(bytes) == place.checksum; };
    return isRight() || (source.readAnew(place.offset, bytes) && isRight());
}

struct Header {
    std::uint32_t version = 0;
    std::uint32_t flags = 0;
    ContentHash hash{};
};

constexpr const char* kNoModel = "not a model (gnomon build MESH -o MODEL.gnm makes one)";

/// Reads and checks the header.
Header readHeader(const hierarchy::Source& source, std::uint64_t fileBytes) {
    if (fileBytes < kHeaderBytes + kFooterBytes)
        throw Error(
            atByte(source.name(), fileBytes),
            kNoModel + std::string(", or one cut off"),
            "at least " + std::to_string(kHeaderBytes + kFooterBytes) + " bytes",
            std::to_string(fileBytes));
    const std::vector<std::byte> bytes = readBytes(source, 0, kHeaderBytes);
    if (!std::ranges::equal(std::span(bytes).first(kMagic.size()), std::as_bytes(std::span(kMagic))))
        throw Error(atByte(source.name(), 0), kNoModel, "the magic of a .gnm", "something else");
    ByteReader in{std::span(bytes).subspan(kMagic.size())};
    Header header;
    header.version = in.take<std::uint32_t>();
    if (header.version < kOldestFormatVersion || header.version > kFormatVersion)
        throw Error(
            atByte(source.name(), kMagic.size()),
            "made by another version of gnomon; build it again from its source",
            "format version " + std::to_string(kOldestFormatVersion) + " to " + std::to_string(kFormatVersion),
            std::to_string(header.version));
    header.flags = in.take<std::uint32_t>();
    std::ranges::copy(std::span(bytes).subspan(kHashOffset), header.hash.begin());
    if (encodeHeader(header.flags, header.hash, header.version) != bytes)
        throw Error(atByte(source.name(), 0), "damaged header: wrong checksum");
    return header;
}

/// Reads and checks the footer of a model file. The tables must be inside the file, and reading them must need at most
/// `tableMemory`.
Footer readFooter(const hierarchy::Source& source, std::uint64_t fileBytes, Bytes tableMemory) {
    const std::uint64_t offset = fileBytes - kFooterBytes;
    try {
        const Footer footer = decodeFooter(readBytes(source, offset, kFooterBytes));
        if (footer.fileBytes != fileBytes)
            throw Damage{
                "the file should have " + std::to_string(footer.fileBytes) + " bytes and has " +
                std::to_string(fileBytes)};
        const bool tiled = footer.pageTable.offset >= kHeaderBytes && footer.pageTable.offset <= offset &&
                           footer.pageTable.bytes <= offset - footer.pageTable.offset &&
                           footer.summary.offset == footer.pageTable.offset + footer.pageTable.bytes &&
                           footer.summary.bytes == offset - footer.summary.offset;
        if (!tiled) throw Damage{"the tables are at wrong offsets"};
        const Bytes needed{hierarchy::tableMemory(footer)};
        if (footer.summary.bytes > kMaxSummaryBytes)
            throw Damage{
                "bytes of the summary: expected at most " + std::to_string(kMaxSummaryBytes) + ", found " +
                std::to_string(footer.summary.bytes)};
        if (needed > tableMemory)
            throw LimitError(
                Limit::PageMemory,
                {atByte(source.name(), footer.pageTable.offset),
                 "the page table is larger than the memory for pages",
                 "at most " + readableBytes(tableMemory),
                 readableBytes(needed)});
        return footer;
    } catch (const Damage& damage) {
        throw Error(atByte(source.name(), offset), "damaged footer, or a file cut off: " + damage.what);
    }
}

/// Reads the table at `place`, checks its checksum and decodes it. Error messages call the table `name`.
template <class Decode>
auto readTable(const hierarchy::Source& source, const TablePlace& place, const char* name, Decode decode) {
    std::vector<std::byte> bytes = readBytes(source, place.offset, place.bytes);
    try {
        if (!isAsWritten(source, place, bytes)) throw Damage{"wrong checksum"};
        return decode(std::span<const std::byte>(bytes));
    } catch (const Damage& damage) {
        throw Error(atByte(source.name(), place.offset), std::string("damaged ") + name + ": " + damage.what);
    }
}

bool hasLayoutOf(const FieldLayout& layout, const std::vector<Field>& fields) {
    return layout.count() == fields.size() &&
           std::ranges::equal(
               fields, std::span(layout.bits).first(fields.size()), [](const Field& field, std::uint8_t bits) {
                   return field.bits == bits;
               });
}

} // namespace

ModelFile::ModelFile(const std::string& path, Bytes tableMemory)
    : ModelFile(hierarchy::openSource(path), tableMemory) {}

ModelFile::ModelFile(std::unique_ptr<hierarchy::Source> source, Bytes tableMemory)
    : source_(std::move(source)), fileBytes_(source_->size()) {
    const Header header = readHeader(*source_, fileBytes_);
    formatVersion_ = header.version;
    contentHash_ = hexText(header.hash);
    const Footer footer = readFooter(*source_, fileBytes_, tableMemory);
    summary_ = readTable(*source_, footer.summary, "summary", [&](std::span<const std::byte> bytes) {
        return decodeSummary(bytes, header.version);
    });
    if (flagsOf(summary_) != header.flags)
        throw Error(atByte(path(), footer.summary.offset), "damaged summary: its flags differ from the header");
    pages_ = readTable(*source_, footer.pageTable, "page table", [&](std::span<const std::byte> bytes) {
        return decodePageTable(bytes, footer, summary_.grid);
    });
    if (const auto fault = modelFault(pages_, summary_))
        throw Error(atByte(path(), footer.pageTable.offset), "page table and summary contradict each other: " + *fault);
}

std::string ModelFile::computedContentHash() const {
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    std::vector<std::byte> buffer(std::size_t{1} << 20U);
    for (std::uint64_t offset = kHeaderBytes; offset < fileBytes_; offset += buffer.size()) {
        const auto part = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), fileBytes_ - offset));
        source_->readAt(offset, part);
        XXH3_128bits_update(state.get(), part.data(), part.size());
    }
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state.get()));
    ContentHash hash{};
    std::memcpy(hash.data(), canonical.digest, hash.size());
    return hexText(hash);
}

Page ModelFile::readPage(std::uint32_t page) const {
    thread_local PageFields fields; // reused to avoid an allocation per page
    return readPage(page, fields);
}

Page ModelFile::readPage(std::uint32_t page, PageFields& fields) const {
    const PageInfo& info = pages_.at(page);
    // The buffer is reused to avoid an allocation per page, like all buffers of the decoder.
    thread_local std::vector<std::byte> bytes;
    bytes.resize(info.storedBytes);
    source_->readAt(info.offset, bytes);
    try {
        if (!isAsWritten(*source_, {info.offset, info.storedBytes, info.checksum}, bytes))
            throw Damage{"wrong checksum"};
        Page decoded = decodePageBytes(bytes, info, fields);
        if (!hasLayoutOf(fields.layout, summary_.fields)) throw Damage{"its fields differ from the summary"};
        return decoded;
    } catch (const Damage& damage) {
        throw PageDamage(atByte(path(), info.offset), "damaged page " + std::to_string(page) + ": " + damage.what);
    }
}

} // namespace gnomon::hierarchy
