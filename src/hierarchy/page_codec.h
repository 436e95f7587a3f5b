// A page as bytes: tables of groups, refinements and clusters, then their geometry, the whole through zstd.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <span>
#include <vector>

namespace gnomon::hierarchy {

/// The zstd level of every page, by measurement (bytes against build time; decoding is alike at all levels).
constexpr int kCompressionLevel = 1;

/// The stored form of `page` and of the `fields` of its vertices: a pure function of both. Other pages are named by
/// their place among the page's children in the page table, never by their ids; so a page can be encoded before it is
/// known where in the file it will lie, as long as its children's ids are in the right order.
std::vector<std::byte> encodePageBytes(const Page& page, const PageFields& fields = {});

/// The page whose stored form is `bytes` and whose row in the page table is `info`. Every count, index and range is
/// checked before it is used, and no more is allocated than a page may take. Throws Damage; bad_alloc where there is no
/// memory.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info);

/// The same with the `fields` of its vertices.
Page decodePageBytes(std::span<const std::byte> bytes, const PageInfo& info, PageFields& fields);

} // namespace gnomon::hierarchy
