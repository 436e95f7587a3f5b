// The clusters of an image that are coarser than the error limit requires, because finer pages are not in memory.
#pragma once

#include "executor/executor.h"

#include <functional>
#include <span>

namespace gnomon::executor {

/// Returns the clusters of `image`, a draw list of `query`, whose refinement should have been drawn. They are sorted by
/// page and cluster. `isDamaged` returns true for a page that could not be read.
std::vector<LodSubstitute> lodSubstitutes(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    const std::function<bool(std::uint32_t page)>& isDamaged);

/// Returns the reason why `cluster` of `page` is drawn.
Residence residenceOf(std::span<const LodSubstitute> substitutes, std::uint32_t page, std::uint32_t cluster);

/// Returns the clusters of `image` that are drawn for the reason `residence`.
selection::DrawList drawnAs(
    const selection::DrawList& image,
    std::span<const LodSubstitute> substitutes,
    Residence residence,
    const PageLookup& pages);

} // namespace gnomon::executor
