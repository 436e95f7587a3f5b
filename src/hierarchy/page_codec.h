// The encoding of a page as bytes: tables of groups, refinements and clusters, then the geometry, all compressed by
// zstd.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <span>
#include <vector>

namespace gnomon::hierarchy {

/// The zstd level of all pages. It was chosen by measuring file size against build time. Decoding is equally fast at
/// all levels.
constexpr int kCompressionLevel = 1;

/// Encodes `page` and the `fields` of its vertices. This is a pure function. A refinement names another page by its
/// index among the children in the page table, not by its id. Therefore a page can be encoded before its place in the
/// file is known, if the ids of its children are in the correct order.
std::vector<std::byte> encodePageBytes(const Page& page, const PageFields& fields = {});

/// Decodes the page with the row `info` of the page table. Checks each count, index and range before its use, and never
/// allocates more than the size limit of a page. Throws Damage if the bytes are invalid, and bad_alloc if memory is
/// exhausted.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info);

/// Decodes the page and the `fields` of its vertices.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info, PageFields& fields);

} // namespace gnomon::hierarchy
