// Divides a model into cells of space. Each cell fits into memory with all pages that overlap it.
#pragma once

#include "core/units.h"
#include "hierarchy/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::verify {

/// A cell with its pages.
struct CrackCell {
    hierarchy::GridBox box;           // closed; the cells are disjoint and fill the grid
    std::vector<std::uint32_t> pages; // ascending pages whose boxes overlap the cell
    std::uint64_t bytes = 0;          // max memory of the crack search in this cell
};

/// Returns cells in which `threads` threads can search for cracks within `memory`. A cell needs more memory if its
/// pages overlap so much that no cut separates them.
std::vector<CrackCell> crackCells(std::span<const hierarchy::PageInfo> pages, Bytes memory, std::size_t threads = 1);

} // namespace gnomon::verify
