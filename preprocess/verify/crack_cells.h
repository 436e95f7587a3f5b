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
};

/// Cells in which looking for cracks takes about `memory`; more where pages lie over one another so that no cut parts
/// them.
std::vector<CrackCell> crackCells(std::span<const hierarchy::PageInfo> pages, Bytes memory);

} // namespace gnomon::verify
