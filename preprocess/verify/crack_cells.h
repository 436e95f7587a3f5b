// Divides the space of a model into boxes (cells). Each cell fits into memory together with all pages that overlap it.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::verify {

/// A box of the model's space and the pages that overlap it.
struct CrackCell {
    hierarchy::GridBox box;           // includes its border; the cells are disjoint and fill the grid
    std::vector<std::uint32_t> pages; // numbers of the pages whose boxes overlap the cell, in ascending order
    std::uint64_t bytes = 0;          // max memory for the crack search in this cell
};

/// Returns cells in which `threads` threads can search for cracks with at most `memory` bytes. A cell exceeds this
/// limit if its pages overlap so much that no plane separates them.
std::vector<CrackCell> crackCells(std::span<const hierarchy::PageInfo> pages, Bytes memory, std::size_t threads = 1);

} // namespace gnomon::verify
