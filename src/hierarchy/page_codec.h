// Encodes and decodes a page: tables of groups, refinements and clusters, and then the geometry. zstd compresses all
// of them.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <span>
#include <vector>

namespace gnomon::hierarchy {

/// The zstd compression level of all pages. It was chosen by measuring file sizes and build times. The decoding speed
/// is the same for all levels.
constexpr int kCompressionLevel = 1;

/// Encodes `page` and the `fields` of its vertices as bytes. The function is pure. Another page is stored as an index
/// among the children in the page table, not as a page id. A page can therefore be encoded before its id in the file is
/// known. Only the order of the children's ids must be correct.
std::vector<std::byte> encodePageBytes(const Page& page, const PageFields& fields = {});

/// Decodes the page that the page table row `info` describes. Checks each count, index and range before its use. Never
/// allocates more than the size limit of a page. Throws Damage if the bytes are invalid, and bad_alloc if memory is
/// exhausted.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info);

/// Decodes a page and also the `fields` of its vertices. Checks and errors are the same as without fields.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info, PageFields& fields);

} // namespace gnomon::hierarchy
