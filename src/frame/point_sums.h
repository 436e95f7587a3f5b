// Sums over boxes of the cells that samples are sorted into, by tables of what lies below and left of each corner
// (summed area tables: Crow 1984).
#pragma once

#include "exact/receiver_mask.h"
#include "plan/cell_maps.h"

#include <cstdint>
#include <vector>

namespace gnomon::frame {

inline constexpr int kBlockBits = exact::ReceiverMask::kBlockBits;
inline constexpr int kBlockSide = 1 << kBlockBits;                   // cells
inline constexpr std::size_t kBlocks = plan::kCellSide / kBlockSide; // on each side

/// How many points lie in boxes of cells.
struct PointSums {
    std::vector<float> below; // in the cells with lesser x and lesser y

    /// Of the points of cell i, which are those from first[i] on, the share of its block; all if there are none.
    void add(const std::vector<std::uint32_t>& first, const std::vector<double>& shares);
    double in(const exact::CellBox& box) const;
};

/// How many cells of boxes lie in blocks with points: what is even over a block is linear between its corners.
struct AskedCells {
    std::vector<double> below; // of the blocks with lesser x and lesser y

    void add(const exact::ReceiverMask& mask);
    double in(const exact::CellBox& box) const;
};

} // namespace gnomon::frame
