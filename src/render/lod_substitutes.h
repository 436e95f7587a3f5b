// Finds the clusters of an image that are coarser than the error limit allows, because finer pages are not in memory.
#pragma once

#include "render/backend.h"

#include <functional>
#include <span>

namespace gnomon::render {

/// Returns the clusters of `image` that are coarser than the error limit allows, sorted by page and cluster. `image` is
/// a draw list of `query`. `isDamaged` returns true for a page that could not be read.
std::vector<LodSubstitute> lodSubstitutes(
    const lod::CutQuery& query, const lod::DrawList& image, const std::function<bool(std::uint32_t page)>& isDamaged);

/// Returns the reason why `cluster` of `page` is drawn instead of finer clusters.
Residence residenceOf(std::span<const LodSubstitute> substitutes, std::uint32_t page, std::uint32_t cluster);

/// Returns the clusters of `image` that are drawn for the reason `residence`.
lod::DrawList drawnAs(
    const lod::DrawList& image,
    std::span<const LodSubstitute> substitutes,
    Residence residence,
    const PageLookup& pages);

} // namespace gnomon::render
