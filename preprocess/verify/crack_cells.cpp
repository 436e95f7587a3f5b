#include "preprocess/verify/crack_cells.h"

#include "preprocess/verify/locked_edges.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace gnomon::verify {

using namespace hierarchy;

namespace {

/// Bytes per vertex for the index of locked edges: the vertex's sorted entry, the number of its position, its first
/// edge, and its uses by groups and edges.
constexpr std::uint64_t kBytesPerVertex = 36;

/// Bytes per vertex in each thread that tests cuts. They store the state of the edges at this vertex.
constexpr std::uint64_t kBytesPerVertexAndThread = 2;
constexpr double kMinGain = 0.95; // a cut is useful if the memory of each side shrinks at least to this share
constexpr std::array kAxes = {&GridPoint::x, &GridPoint::y, &GridPoint::z};

class Cells {
public:
    Cells(std::span<const PageInfo> pages, Bytes memory, std::size_t threads)
        : pages_(pages), memory_(memory), bytesPerVertex_(kBytesPerVertex + threads * kBytesPerVertexAndThread) {}

    void cut(CrackCell cell) {
        const std::uint64_t whole = cell.bytes = bytes(cell);
        if (whole > memory_.count) {
            for (const auto axis : longestFirst(cell)) {
                const std::uint32_t at = middle(cell, axis);
                if (at >= cell.box.max.*axis) continue; // a plane there would not divide the cell
                CrackCell low{cell.box, {}};
                CrackCell high{cell.box, {}};
                low.box.max.*axis = at;
                high.box.min.*axis = at + 1;
                for (const std::uint32_t page : cell.pages) {
                    if (pages_[page].box.min.*axis <= at) low.pages.push_back(page);
                    if (pages_[page].box.max.*axis > at) high.pages.push_back(page);
                }
                const auto maxBytes = static_cast<double>(std::max(bytes(low), bytes(high)));
                if (maxBytes > kMinGain * static_cast<double>(whole)) continue;
                cut(std::move(low));
                cut(std::move(high));
                return;
            }
        }
        found_.push_back(std::move(cell));
    }

    std::vector<CrackCell> found() { return std::move(found_); }

private:
    std::uint64_t bytes(const CrackCell& cell) const {
        std::uint64_t sum = 0;
        for (const std::uint32_t page : cell.pages)
            sum += decodedPageBytes(pages_[page]) + bytesPerVertex_ * pages_[page].vertexCount;
        return sum;
    }

    /// Returns the three axes, sorted by the extent of the pages of `cell`. The axis of the longest extent is first.
    std::array<std::uint32_t GridPoint::*, 3> longestFirst(const CrackCell& cell) const {
        GridBox box;
        for (const std::uint32_t page : cell.pages)
            box.add(pages_[page].box);
        std::array<std::uint32_t GridPoint::*, 3> axes = kAxes;
        const auto length = [&](auto axis) {
            return std::min(box.max.*axis, cell.box.max.*axis) - std::max(box.min.*axis, cell.box.min.*axis);
        };
        std::stable_sort(axes.begin(), axes.end(), [&](auto a, auto b) { return length(a) > length(b); });
        return axes;
    }

    /// Returns the median of the centres of the pages of `cell` along `axis`, clamped to the cell.
    std::uint32_t middle(const CrackCell& cell, std::uint32_t GridPoint::*axis) const {
        std::vector<std::uint32_t> middles;
        for (const std::uint32_t page : cell.pages)
            middles.push_back(std::midpoint(pages_[page].box.min.*axis, pages_[page].box.max.*axis));
        const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
        std::nth_element(middles.begin(), half, middles.end());
        return std::clamp(*half, cell.box.min.*axis, cell.box.max.*axis);
    }

    std::span<const PageInfo> pages_;
    Bytes memory_;
    std::uint64_t bytesPerVertex_;
    std::vector<CrackCell> found_;
};

} // namespace

std::vector<CrackCell> crackCells(std::span<const PageInfo> pages, Bytes memory, std::size_t threads) {
    CrackCell whole{kWholeGrid, std::vector<std::uint32_t>(pages.size())};
    std::iota(whole.pages.begin(), whole.pages.end(), 0U);
    Cells cells(pages, memory, threads);
    cells.cut(std::move(whole));
    return cells.found();
}

} // namespace gnomon::verify
