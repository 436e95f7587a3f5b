#include "hierarchy/model_file.h"

#include "hierarchy/file_layout.h"
#include "hierarchy/page_codec.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include <xxhash.h>

namespace gnomon::hierarchy {

namespace {

/// Fills `bytes` from `offset`; tries again where a read fails, for what fails once on a network or a disk that wakes
/// up is there a little later. Throws Error if the last try fails, too.
void readPatiently(const File& file, std::uint64_t offset, std::span<std::byte> bytes) {
    constexpr int kRetries = 3;
    std::chrono::milliseconds pause(1);
    for (int retry = 0; retry < kRetries; ++retry, pause *= 4) {
        try {
            return file.readAt(offset, bytes);
        } catch (const Error&) {
            std::this_thread::sleep_for(pause);
        }
    }
    file.readAt(offset, bytes);
}

/// `count` must be known to lie within the file.
std::vector<std::byte> readBytes(const File& file, std::uint64_t offset, std::uint64_t count) {
    std::vector<std::byte> bytes(count);
    readPatiently(file, offset, bytes);
    return bytes;
}

struct Header {
    std::uint32_t version = 0;
    std::uint32_t flags = 0;
    ContentHash hash{};
};

constexpr const char* kNoModel = "not a model (gnomon build MESH -o MODEL.gnm makes one)";

/// The header after its checks.
Header readHeader(const File& file, std::uint64_t fileBytes) {
    if (fileBytes < kHeaderBytes + kFooterBytes)
        throw Error(
            atByte(file.path(), fileBytes),
            kNoModel + std::string(", or one cut off"),
            "at least " + std::to_string(kHeaderBytes + kFooterBytes) + " bytes",
            std::to_string(fileBytes));
    const std::vector<std::byte> bytes = readBytes(file, 0, kHeaderBytes);
    if (!std::ranges::equal(std::span(bytes).first(kMagic.size()), std::as_bytes(std::span(kMagic))))
        throw Error(atByte(file.path(), 0), kNoModel, "the magic of a .gnm", "something else");
    ByteReader in{std::span(bytes).subspan(kMagic.size())};
    Header header;
    header.version = in.take<std::uint32_t>();
    if (header.version < kOldestFormatVersion || header.version > kFormatVersion)
        throw Error(
            atByte(file.path(), kMagic.size()),
            "made by another version of gnomon; build it again from its source",
            "format version " + std::to_string(kOldestFormatVersion) + " to " + std::to_string(kFormatVersion),
            std::to_string(header.version));
    header.flags = in.take<std::uint32_t>();
    std::ranges::copy(std::span(bytes).subspan(kHashOffset), header.hash.begin());
    if (encodeHeader(header.flags, header.hash, header.version) != bytes)
        throw Error(atByte(file.path(), 0), "damaged header: wrong checksum");
    return header;
}

/// The footer, whose tables lie within the file and take no more than `tableMemory` while they are read.
Footer readFooter(const File& file, std::uint64_t fileBytes, Bytes tableMemory) {
    const std::uint64_t offset = fileBytes - kFooterBytes;
    try {
        const Footer footer = decodeFooter(readBytes(file, offset, kFooterBytes));
        if (footer.fileBytes != fileBytes)
            throw Damage{
                "the file should have " + std::to_string(footer.fileBytes) + " bytes and has " +
                std::to_string(fileBytes)};
        const bool tiled = footer.pageTable.offset >= kHeaderBytes && footer.pageTable.offset <= offset &&
                           footer.pageTable.bytes <= offset - footer.pageTable.offset &&
                           footer.summary.offset == footer.pageTable.offset + footer.pageTable.bytes &&
                           footer.summary.bytes == offset - footer.summary.offset;
        if (!tiled) throw Damage{"the tables are not where they should be"};
        const Bytes needed{hierarchy::tableMemory(footer)};
        if (footer.summary.bytes > kMostSummaryBytes)
            throw Damage{
                "bytes of the summary: expected at most " + std::to_string(kMostSummaryBytes) + ", found " +
                std::to_string(footer.summary.bytes)};
        if (needed > tableMemory)
            throw Error(
                atByte(file.path(), footer.pageTable.offset),
                "the page table alone takes more than the page memory",
                "at most " + readableBytes(tableMemory),
                readableBytes(needed));
        return footer;
    } catch (const Damage& damage) {
        throw Error(atByte(file.path(), offset), "damaged footer, or a file cut off: " + damage.what);
    }
}

/// Reads the table at `place` and decodes it.
template <class Decode>
auto readTable(const File& file, const TablePlace& place, const char* name, Decode decode) {
    const std::vector<std::byte> bytes = readBytes(file, place.offset, place.bytes);
    try {
        if (checksum64(bytes) != place.checksum) throw Damage{"wrong checksum"};
        return decode(std::span<const std::byte>(bytes));
    } catch (const Damage& damage) {
        throw Error(atByte(file.path(), place.offset), std::string("damaged ") + name + ": " + damage.what);
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
    : file_(path, File::Mode::Read), fileBytes_(file_.size()) {
    const Header header = readHeader(file_, fileBytes_);
    formatVersion_ = header.version;
    contentHash_ = hexText(header.hash);
    const Footer footer = readFooter(file_, fileBytes_, tableMemory);
    summary_ = readTable(file_, footer.summary, "summary", [&](std::span<const std::byte> bytes) {
        return decodeSummary(bytes, header.version);
    });
    if (flagsOf(summary_) != header.flags)
        throw Error(atByte(path, footer.summary.offset), "damaged summary: its flags are not the header's");
    pages_ = readTable(file_, footer.pageTable, "page table", [&](std::span<const std::byte> bytes) {
        return decodePageTable(bytes, footer, summary_.grid);
    });
    if (const auto fault = modelFault(pages_, summary_))
        throw Error(atByte(path, footer.pageTable.offset), "page table and summary contradict each other: " + *fault);
}

std::string ModelFile::computedContentHash() const {
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    std::vector<std::byte> buffer(std::size_t{1} << 20U);
    for (std::uint64_t offset = kHeaderBytes; offset < fileBytes_; offset += buffer.size()) {
        const auto part = std::span(buffer).first(std::min<std::uint64_t>(buffer.size(), fileBytes_ - offset));
        readPatiently(file_, offset, part);
        XXH3_128bits_update(state.get(), part.data(), part.size());
    }
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state.get()));
    ContentHash hash{};
    std::memcpy(hash.data(), canonical.digest, hash.size());
    return hexText(hash);
}

Page ModelFile::readPage(std::uint32_t page) const {
    thread_local PageFields fields; // kept likewise
    return readPage(page, fields);
}

Page ModelFile::readPage(std::uint32_t page, PageFields& fields) const {
    const PageInfo& info = pages_.at(page);
    thread_local std::vector<std::byte> bytes; // kept from page to page, as what decoding needs is
    bytes.resize(info.storedBytes);
    readPatiently(file_, info.offset, bytes);
    try {
        if (checksum64(bytes) != info.checksum) throw Damage{"wrong checksum"};
        Page decoded = decodePageBytes(bytes, info, fields);
        if (!hasLayoutOf(fields.layout, summary_.fields)) throw Damage{"its fields are not those of the summary"};
        return decoded;
    } catch (const Damage& damage) {
        throw PageDamage(
            atByte(file_.path(), info.offset), "damaged page " + std::to_string(page) + ": " + damage.what);
    }
}

} // namespace gnomon::hierarchy
