// Converts one level of a mesh to pages of a .gnm file: it assigns groups to pages and encodes the pages.
#pragma once

#include "hierarchy/model_writer.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

using hierarchy::kMaxLevels;

/// The max number of pages of a level.
constexpr std::uint32_t kMaxLevelPages = 1U << 26U;

/// Returns a provisional id of page `page` of level `level`. Provisional ids are known before the final ids of the
/// file, and have the same order.
std::uint32_t provisionalId(std::uint32_t level, std::uint32_t page);

/// A page, by its level and its number within the level.
struct PageOfLevel {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
};

/// Returns the page of a provisional id.
PageOfLevel placeOfProvisional(std::uint32_t id);

/// Assigns each group of `level` (index `number`) to a page. Pages have about kPageTargetBytes, are numbered from 0,
/// and contain groups of similar error in the order of the groups. Returns the number of pages.
std::uint32_t placeGroups(Level& level, std::uint32_t number);

/// Encodes the `pageCount` pages of `level`. References to other pages are provisional ids.
std::vector<hierarchy::EncodedPage> encodePages(
    const simplify::Mesh& mesh, const Level& level, std::uint32_t number, std::uint32_t pageCount);

} // namespace gnomon::levels
