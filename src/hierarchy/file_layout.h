// The byte layout of a .gnm file and its tables. All numbers are little-endian:
//   header      magic 8, format version u32, flags u32, checksum of these and the hash u64, content hash 16
//   pages       in sequence without gaps, in the order of the page table
//   page table  one row per page
//   summary     the values that `gnomon info` prints
//   footer      places, sizes and checksums of both tables, the size of the file, the number of pages, its own checksum
// All bytes after the hash are written once, in order. The checksum and the hash of the header are written last.
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

/// Returns the 64-bit xxh3 hash of `bytes` as a checksum.
std::uint64_t checksum64(std::span<const std::byte> bytes);

/// A 128-bit xxh3 hash in its canonical (big-endian) bytes.
using ContentHash = std::array<std::byte, kHashBytes>;

/// Returns the content hash as text, with two lower-case hexadecimal digits per byte.
std::string hexText(const ContentHash& hash);

/// Encodes the header of a model file. Bit 0 of `flags` means that vertices have normals, and bit 1 that they have
/// colours.
std::vector<std::byte> encodeHeader(
    std::uint32_t flags, const ContentHash& hash, std::uint32_t version = kFormatVersion);

std::uint32_t flagsOf(const ModelSummary& summary);

/// The position of a table in the model file, and its checksum.
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

/// Decodes the footer of a model file. Throws Damage if its checksum is wrong.
Footer decodeFooter(std::span<const std::byte> bytes);

/// Encodes `page` as a row of the page table. The row contains all members except the offset, which follows from the
/// earlier rows.
void putPageRow(ByteWriter& out, const PageInfo& page);

/// Decodes a row of the page table. The function does not check the values, and the offset remains 0. Throws Damage if
/// the bytes end too early.
PageInfo takePageRow(ByteReader& in);

std::vector<std::byte> encodePageTable(std::span<const PageInfo> pages);

/// Returns the max memory in bytes that reading and decoding the page table needs. Throws Damage if the file is too
/// small for the number of pages in `footer`.
std::uint64_t tableMemory(const Footer& footer);

/// Decodes the page table of a model whose vertex grid is `grid`. Throws Damage if a row is invalid, or if the pages do
/// not exactly fill the file between the header and the table.
std::vector<PageInfo> decodePageTable(std::span<const std::byte> bytes, const Footer& footer, const Grid& grid);

std::vector<std::byte> encodeSummary(const ModelSummary& summary);

/// Decodes the summary of a model file with the format version `version`. Throws Damage if the summary is invalid.
ModelSummary decodeSummary(std::span<const std::byte> bytes, std::uint32_t version = kFormatVersion);

} // namespace gnomon::hierarchy
