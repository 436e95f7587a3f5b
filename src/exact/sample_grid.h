// The samples of a frame, sorted into the cells of a warped grid over the light plane: those that a triangle may shadow
// lie side by side (the irregular z-buffer of Johnson et al. 2005; alias-free shadow maps of Aila and Laine 2004).
#pragma once

#include "exact/blocks/sample_blocks.h"
#include "exact/cell_kernel.h"
#include "exact/receiver_mask.h"

#include <glm/mat3x3.hpp>

#include <functional>
#include <vector>

namespace gnomon::exact {

/// The cells of one map: of the light plane, (u, v, 1) -> (x, y, 1) w, or of what a point light sees through a face of
/// a cube, (u, v, h, 1) -> (x, y, 1) w. Which one only changes the time.
struct CellMap {
    glm::dmat4x3 cellsFromLight{0}; // columns of u, v, h and 1
    double leastW = 0;              // corners with less are too near or behind; of a direction samples have twice that
    bool isEmpty = true;
    int nearAxis = 2;    // of u, v and h that which, times `nearSign`, grows towards the light
    double nearSign = 1; // 1 or -1
};

/// Cells by which a triangle's box has to grow: more than x and y of corners and samples can be off together.
constexpr double kCellSlack = 2e-3;

/// The samples by map, row and column of their cells.
class SampleGrid {
public:
    /// Sorts `samples` into side x side cells a map, side at most 16384. `planes` holds a homography a map of the
    /// samples, to any coordinates: they are stretched so that the samples fill the cells. A map is used without its
    /// warp where w is not above 0 at each of its samples, varies by more than 2^20 among them, or where coordinates
    /// that are `coordinateError` off (see coordinateErrorFor) could move a point by more than a share of kCellSlack;
    /// without a warp cells stay so large that they cannot. Puts `samples`' u, v and h in the order of the cells; what
    /// else they have stays where it is, and `source` says where. Of a point light it takes the faces of its cube for
    /// `planes`.
    void sort(SampleList& samples, std::span<const glm::dmat3> planes, int side, double coordinateError);

    /// Takes out the samples that `leaves(place)` names and makes the masks anew; the others keep their order, and so
    /// do their `statuses`, which lie by place. Calls `leave(place)` for each that goes, from any thread. `samples` as
    /// `sort` left them. Runs in the caller's TBB arena.
    template <class Leaves, class Leave>
    void remove(SampleList& samples, FrameArray<std::uint8_t>& statuses, const Leaves& leaves, const Leave& leave);

    int side() const { return side_; }

    std::span<const CellMap> maps() const { return maps_; }

    const ReceiverMask& mask(std::size_t map) const { return masks_[map]; }

    /// The first sample of cell (x, y) of `map`; its last is before the next cell's first.
    std::uint32_t first(std::size_t map, int x, int y) const { return first_[cell(map, x, y)]; }

    /// Boxes of samples side by side, but about a point light.
    const SampleBlocks& blocks() const { return blocks_; }

    /// Of each sample: its triangle and its place in the list.
    FrameArray<std::uint32_t> triangle, source;

    std::size_t size() const { return size_; }

    /// What the arrays take of memory a sample.
    static constexpr std::uint64_t kBytesPerSample =
        2 * sizeof(std::uint32_t) + sizeof(double) + SampleBlocks::kBytesPerSample;

    /// What the cells take of memory, without the masks.
    std::uint64_t cellBytes() const { return first_.size() * sizeof(std::uint32_t); }

private:
    std::size_t cell(std::size_t map, int x, int y) const {
        const auto side = static_cast<std::size_t>(side_);
        return (map * side + static_cast<std::size_t>(y)) * side + static_cast<std::size_t>(x);
    }

    /// A run of samples that one thread takes care of.
    struct Piece {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::size_t firstCell = 0; // that begins within it
        std::size_t kept = 0;      // samples: its first
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
    std::vector<CellMap> maps_;
    std::vector<ReceiverMask> masks_;
    std::vector<std::uint32_t> first_; // by cell, and the end
    std::vector<Piece> pieces_;        // of what is being removed
    SampleBlocks blocks_;
    FrameArray<double> spare_; // of a sample its cell and its rank there, and then the next array to be sorted
};

template <class Leaves, class Leave>
void SampleGrid::remove(
    SampleList& samples, FrameArray<std::uint8_t>& statuses, const Leaves& leaves, const Leave& leave) {
    forPieces([&](Piece& piece) {
        std::size_t to = piece.begin;
        std::size_t cell = piece.firstCell;
        for (std::size_t from = piece.begin; from < piece.end; ++from) {
            for (; first_[cell] == from; ++cell)
                first_[cell] = static_cast<std::uint32_t>(to);
            if (leaves(from)) {
                leave(from);
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
