// From one level of a mesh to pages of a .gnm: which group lies where, and the pages themselves.
#pragma once

#include "hierarchy/model_writer.h"
#include "preprocess/levels/level.h"

namespace gnomon::levels {

using hierarchy::kMaxLevels;

/// The most pages of a level.
constexpr std::uint32_t kMaxLevelPages = 1U << 26U;

/// What stands for the id that page `page` of level `level` will have in the file: in the same order, but known at
/// once.
std::uint32_t provisionalId(std::uint32_t level, std::uint32_t page);

struct PageOfLevel {
    std::uint32_t level = 0;
    std::uint32_t page = 0;
};

/// What `provisionalId` was made of.
PageOfLevel placeOfProvisional(std::uint32_t id);

/// Gives every group of `level`, the `number`th from 0, its place: pages of about kPageTargetBytes, counted from 0,
/// filled in the order of the groups with those whose errors are alike. Returns how many pages.
std::uint32_t placeGroups(Level& level, std::uint32_t number);

/// The `pageCount` pages of `level`, encoded; other pages are named by their provisional ids.
std::vector<hierarchy::EncodedPage> encodePages(
    const simplify::Mesh& mesh, const Level& level, std::uint32_t number, std::uint32_t pageCount);

} // namespace gnomon::levels
