// Converts one level of detail to pages of a .gnm file. It assigns groups to pages and encodes the pages.
#pragma once

#include "hierarchy/model_writer.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

using hierarchy::kMaxLevels;

/// The max number of pages of a level of detail.
constexpr std::uint32_t kMaxLevelPages = 1U << 26U;

/// Returns a provisional page id for page `page` of level `level`. The build uses provisional ids until the final page
/// ids of the file are known. Both kinds of ids have the same order.
std::uint32_t provisionalId(std::uint32_t level, std::uint32_t page);

/// A page, given by its level of detail and its number within the level.
struct PageOfLevel {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
};

/// Returns the level and the page number of the provisional page id `id`.
PageOfLevel placeOfProvisional(std::uint32_t id);

/// Assigns each group of `level` to a page and returns the number of pages. `number` is the index of the level. Pages
/// have about kPageTargetBytes bytes and are numbered from 0. A page contains groups of similar error, in the order of
/// the groups.
std::uint32_t placeGroups(Level& level, std::uint32_t number);

/// Encodes the `pageCount` pages of `level`, whose level index is `number`. Pages refer to other pages by provisional
/// ids.
std::vector<hierarchy::EncodedPage> encodePages(
    const simplify::Mesh& mesh, const Level& level, std::uint32_t number, std::uint32_t pageCount);

} // namespace gnomon::levels
