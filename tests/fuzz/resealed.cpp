#include "resealed.h"

#include "hierarchy/bytes.h"
#include "hierarchy/file_layout.h"

#include <algorithm>

namespace gnomon::fuzz {

namespace {

using namespace hierarchy;

constexpr std::uint64_t kRowBytes = 108; // without children
constexpr std::uint64_t kChecksumInRow = 8;
constexpr std::uint64_t kChildCountInRow = 60;

template <class T>
T valueAt(std::span<const std::byte> bytes, std::uint64_t offset) {
    return ByteReader(bytes.subspan(offset)).take<T>();
}

template <class T>
void putAt(std::span<std::byte> bytes, std::uint64_t offset, T value) {
    std::memcpy(bytes.subspan(offset, sizeof value).data(), &value, sizeof value);
}

/// The checksum of every page whose row and bytes are there.
void resealPages(std::span<std::byte> file, const Footer& footer) {
    std::uint64_t row = footer.pageTable.offset;
    const std::uint64_t end = row + footer.pageTable.bytes;
    std::uint64_t page = kHeaderBytes;
    for (std::uint64_t i = 0; i < footer.pageCount && end - row >= kRowBytes; ++i) {
        const std::uint64_t stored = valueAt<std::uint32_t>(file, row);
        const std::uint64_t children = valueAt<std::uint32_t>(file, row + kChildCountInRow);
        if (page + stored > footer.pageTable.offset || children > (end - row - kRowBytes) / 4) return;
        putAt(file, row + kChecksumInRow, checksum64(file.subspan(page, stored)));
        page += stored;
        row += kRowBytes + 4 * children;
    }
}

} // namespace

std::vector<std::byte> resealed(std::span<const std::byte> bytes) {
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    if (file.size() < kHeaderBytes + kFooterBytes) return file;
    ContentHash hash{};
    std::copy_n(file.begin() + kHashOffset, hash.size(), hash.begin());
    const std::uint32_t version = kOldestFormatVersion + valueAt<std::uint32_t>(file, 8) % 2;
    const std::vector<std::byte> header = encodeHeader(valueAt<std::uint32_t>(file, 12), hash, version);
    std::ranges::copy(header, file.begin());
    const std::uint64_t footerAt = file.size() - kFooterBytes;
    Footer footer;
    const std::uint64_t between = footerAt - kHeaderBytes;
    const auto clipped = [](std::uint64_t value, std::uint64_t max) { return std::min(value, max); };
    footer.pageTable.offset = kHeaderBytes + clipped(valueAt<std::uint64_t>(file, footerAt) - kHeaderBytes, between);
    footer.pageTable.bytes = clipped(valueAt<std::uint64_t>(file, footerAt + 8), footerAt - footer.pageTable.offset);
    footer.summary.offset = footer.pageTable.offset + footer.pageTable.bytes;
    footer.summary.bytes = footerAt - footer.summary.offset;
    footer.fileBytes = file.size();
    footer.pageCount = valueAt<std::uint64_t>(file, footerAt + 56);
    resealPages(file, footer);
    const auto sealed = [&](TablePlace& place) {
        place.checksum = checksum64(std::span<const std::byte>(file).subspan(place.offset, place.bytes));
    };
    sealed(footer.pageTable);
    sealed(footer.summary);
    std::ranges::copy(encodeFooter(footer), file.begin() + static_cast<std::ptrdiff_t>(footerAt));
    return file;
}

} // namespace gnomon::fuzz
