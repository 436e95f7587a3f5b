// The sample grid: the visible points of a frame, sorted into the cells of a warped grid on the light plane. The
// samples that a triangle may shadow are thus adjacent in memory (irregular z-buffer: Johnson et al. 2005; alias-free
// shadow maps: Aila and Laine 2004).
#pragma once

#include "exact/blocks/sample_blocks.h"
#include "exact/cell_kernel.h"
#include "exact/receiver_mask.h"

#include <glm/mat3x3.hpp>

#include <functional>
#include <vector>

namespace gnomon::exact {

/// The projection of light space to the cells of one map. For a directional light it projects a point of the light
/// plane: (u, v, 1) -> (x, y, 1) w. For a point light it projects the view through a face of a cube: (u, v, h, 1) ->
/// (x, y, 1) w. The projection affects only the speed, not the shadows.
struct GridMap {
    glm::dmat4x3 cellsFromLight{0}; // columns of u, v, h and 1
    /// Min usable w. Corners with a smaller w are behind the light or too near to it. Samples of a directional light
    /// have at least twice this w.
    double minW = 0;
    bool isEmpty = true;
    int nearAxis = 2;    // axis of u, v and h whose coordinate, multiplied by `nearSign`, grows towards the light
    double nearSign = 1; // 1 or -1
};

/// Margin in cells by which the box of a triangle is extended. The margin exceeds the rounding errors of corners plus
/// those of samples.
constexpr double kCellSlack = 2e-3;

/// The samples of a frame, sorted by the map, row and column of their cells.
class SampleGrid {
public:
    /// Sorts `samples` into side x side cells per map. `side` is at most 16384. `planes` has one homography per map,
    /// from the light plane to arbitrary coordinates, which the function scales to the cells. The arrays u, v and h of
    /// `samples` are sorted. The other arrays keep their order, and `source` contains their indices. For a point light,
    /// the faces of a cube replace `planes`.
    ///
    /// The function removes the warp of a map in three cases: w is not positive at all samples, w varies by more than
    /// 2^20, or the error `coordinateError` (see coordinateErrorFor) could move a point by more than a fraction of
    /// kCellSlack. Without a warp, cells are so large that this error is harmless.
    void sort(SampleList& samples, std::span<const glm::dmat3> planes, int side, double coordinateError);

    /// Removes the samples for which `isRemoved(place)` is true, and updates the receiver masks. `place` is the index
    /// of a sample in the grid. The other samples and their `statuses` keep their order. Calls `onRemoved(place)` for
    /// each removed sample, from any thread. `samples` must have the order that `sort` created. Runs in the caller's
    /// TBB arena.
    template <class IsRemoved, class OnRemoved>
    void remove(
        SampleList& samples,
        FrameArray<std::uint8_t>& statuses,
        const IsRemoved& isRemoved,
        const OnRemoved& onRemoved);

    int side() const { return side_; }

    std::span<const GridMap> maps() const { return maps_; }

    const ReceiverMask& mask(std::size_t map) const { return masks_[map]; }

    /// Returns the index of the first sample in cell (x, y) of `map`. The samples of this cell end where the samples of
    /// the next cell begin.
    std::uint32_t first(std::size_t map, int x, int y) const { return first_[cell(map, x, y)]; }

    /// Returns the bounding boxes of each eight adjacent samples. Boxes exist only for a directional light.
    const SampleBlocks& blocks() const { return blocks_; }

    /// For each sample in the grid: the id of its triangle, and its index in the sample list.
    FrameArray<std::uint32_t> triangle, source;

    std::size_t size() const { return size_; }

    /// Memory of the grid's arrays per sample, in bytes.
    static constexpr std::uint64_t kBytesPerSample =
        2 * sizeof(std::uint32_t) + sizeof(double) + SampleBlocks::kBytesPerSample;

    /// Returns the memory of the grid cells in bytes, without the receiver masks.
    std::uint64_t cellBytes() const { return first_.size() * sizeof(std::uint32_t); }

private:
    std::size_t cell(std::size_t map, int x, int y) const {
        const auto side = static_cast<std::size_t>(side_);
        return (map * side + static_cast<std::size_t>(y)) * side + static_cast<std::size_t>(x);
    }

    /// A range of samples that one thread processes.
    struct Piece {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::size_t firstCell = 0; // the first cell that begins in the range
        std::size_t kept = 0;      // number of remaining samples, which are moved to the start of the range
    };

    void forPieces(const std::function<void(Piece&)>& visit);
    void closeGaps(SampleList& samples, FrameArray<std::uint8_t>& statuses);
    void fitMaps(const SampleList& samples, std::span<const glm::dmat3> planes, double coordinateError);
    void fitPointMaps(const SampleList& samples, double coordinateError);
    void countCells(const SampleList& samples);
    void order(SampleList& samples);
    void maskAndBox(const SampleList& samples);

    int side_ = 0;
    std::size_t size_ = 0;
    std::vector<GridMap> maps_;
    std::vector<ReceiverMask> masks_;
    std::vector<std::uint32_t> first_; // first sample of each cell, followed by the number of samples
    std::vector<Piece> pieces_;        // pieces of the current removal
    SampleBlocks blocks_;
    FrameArray<double> spare_; // scratch memory: first the cell and rank of each sample, then the next array to sort
};

template <class IsRemoved, class OnRemoved>
void SampleGrid::remove(
    SampleList& samples, FrameArray<std::uint8_t>& statuses, const IsRemoved& isRemoved, const OnRemoved& onRemoved) {
    forPieces([&](Piece& piece) {
        std::size_t to = piece.begin;
        std::size_t cell = piece.firstCell;
        for (std::size_t from = piece.begin; from < piece.end; ++from) {
            for (; first_[cell] == from; ++cell)
                first_[cell] = static_cast<std::uint32_t>(to);
            if (isRemoved(from)) {
                onRemoved(from);
                continue;
            }
            samples.u[to] = samples.u[from];
            samples.v[to] = samples.v[from];
            samples.h[to] = samples.h[from];
            triangle[to] = triangle[from];
            source[to] = source[from];
            statuses[to] = statuses[from];
            ++to;
        }
        piece.kept = to - piece.begin;
    });
    closeGaps(samples, statuses);
    maskAndBox(samples);
}

} // namespace gnomon::exact
