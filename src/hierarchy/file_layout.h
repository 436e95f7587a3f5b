// Where what lies in a .gnm, and its tables as bytes. Little-endian throughout:
//   header    magic 8, format version u32, flags u32, checksum of these and the hash u64, content hash 16
//   pages     one after the other without gaps, in the order of the page table
//   pages'    one row each
//   summary   what `gnomon info` prints
//   footer    places, sizes and checksums of both tables, the size of the file, the number of pages, its own checksum
// Everything after the hash is written once, in order; only the checksum and the hash are filled in at the end.
#pragma once

#include "hierarchy/bytes.h"
#include "hierarchy/model.h"

#include <array>

namespace gnomon::hierarchy {

constexpr std::array<unsigned char, 8> kMagic = {0x89, 'G', 'N', 'M', '\r', '\n', 0x1A, '\n'};
constexpr std::uint64_t kHashBytes = 16;
constexpr std::uint64_t kHeaderBytes = 40;
constexpr std::uint64_t kHashOffset = kHeaderBytes - kHashBytes;
constexpr std::uint64_t kFooterBytes = 72;

/// xxh3-64 of `bytes`.
std::uint64_t checksum64(std::span<const std::byte> bytes);

/// An xxh3-128 in its canonical (big-endian) bytes.
using ContentHash = std::array<std::byte, kHashBytes>;

/// Two lower-case digits a byte.
std::string hexText(const ContentHash& hash);

/// The whole header of a file of a format. Flag bit 0: normals, bit 1: colours.
std::vector<std::byte> encodeHeader(
    std::uint32_t flags, const ContentHash& hash, std::uint32_t version = kFormatVersion);

std::uint32_t flagsOf(const ModelSummary& summary);

/// Where one table lies.
struct TablePlace {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;
};

struct Footer {
    TablePlace pageTable;
    TablePlace summary;
    std::uint64_t fileBytes = 0;
    std::uint64_t pageCount = 0;
};

std::vector<std::byte> encodeFooter(const Footer& footer);

/// Throws Damage.
Footer decodeFooter(std::span<const std::byte> bytes);

/// One row of the page table: all of `page` but its offset, which follows from the rows before.
void putPageRow(ByteWriter& out, const PageInfo& page);

/// What `putPageRow` put, unchecked; its offset is 0. Throws Damage where the bytes end too early.
PageInfo takePageRow(ByteReader& in);

std::vector<std::byte> encodePageTable(std::span<const PageInfo> pages);

/// What reading and decoding the page table that `footer` tells of takes at most, in bytes. Throws Damage where the
/// file has not the bytes for so many rows and pages.
std::uint64_t tableMemory(const Footer& footer);

/// The rows of the page table that `footer` tells of, of a model on `grid`. Throws Damage, also where a row is none of
/// a page and where the pages do not fill the file between the header and the table.
std::vector<PageInfo> decodePageTable(std::span<const std::byte> bytes, const Footer& footer, const Grid& grid);

std::vector<std::byte> encodeSummary(const ModelSummary& summary);

/// Of a file of format `version`. Throws Damage.
ModelSummary decodeSummary(std::span<const std::byte> bytes, std::uint32_t version = kFormatVersion);

} // namespace gnomon::hierarchy
