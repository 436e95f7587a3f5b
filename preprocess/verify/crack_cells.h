// A model cut into cells of space, of which each fits into memory with all pages that meet it.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::verify {

struct CrackCell {
    hierarchy::GridBox box;           // closed; cells do not overlap and fill the grid
    std::vector<std::uint32_t> pages; // whose boxes meet it, ascending
    std::uint64_t bytes = 0;          // looking for cracks in it takes at most
};

/// Cells in which `threads` look for cracks in `memory`; cells take more where pages lie over one another so that no
/// cut parts them.
std::vector<CrackCell> crackCells(std::span<const hierarchy::PageInfo> pages, Bytes memory, std::size_t threads = 1);

} // namespace gnomon::verify
