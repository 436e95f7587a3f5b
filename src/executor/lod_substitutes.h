// What of an image is drawn coarser than its error calls for, since finer pages are not in memory.
#pragma once

#include "executor/executor.h"

#include <functional>
#include <span>

namespace gnomon::executor {

/// The clusters of `image`, a draw list of `query`, that are drawn though the error calls for finer ones, by page and
/// cluster. `isDamaged` says of a page whether it could not be read.
std::vector<LodSubstitute> lodSubstitutes(
    const selection::CutQuery& query,
    const selection::DrawList& image,
    const std::function<bool(std::uint32_t page)>& isDamaged);

/// Why `cluster` of `page` is drawn.
Residence residenceOf(std::span<const LodSubstitute> substitutes, std::uint32_t page, std::uint32_t cluster);

/// What of `image` is drawn for the reason `residence`.
selection::DrawList drawnAs(
    const selection::DrawList& image,
    std::span<const LodSubstitute> substitutes,
    Residence residence,
    const PageLookup& pages);

} // namespace gnomon::executor
