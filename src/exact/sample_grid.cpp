#include "exact/sample_grid.h"

#include "exact/float_rounding.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

namespace gnomon::exact {

namespace {

constexpr std::size_t kChunk = 16384;

/// Divides [0, size) into equal chunks, and calls `visit(begin, end, chunk)` for each chunk in parallel.
template <class Visit>
void forChunks(std::size_t size, const Visit& visit) {
    const std::size_t chunks = (size + kChunk - 1) / kChunk;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        visit(chunk * kChunk, std::min(size, (chunk + 1) * kChunk), chunk);
    });
}

std::vector<Extent> extentsOf(const SampleList& samples, std::span<const glm::dmat4x3> planes) {
    std::vector<std::vector<Extent>> parts((samples.size() + kChunk - 1) / kChunk);
    forChunks(samples.size(), [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t map = 0; map < planes.size(); ++map)
            parts[chunk].push_back(extentOn(planes[map], map, {&samples, begin, end}));
    });
    std::vector<Extent> result(planes.size());
    for (const std::vector<Extent>& part : parts)
        for (std::size_t map = 0; map < part.size(); ++map)
            result[map].add(part[map]);
    return result;
}

/// A transformation from the projection plane of a map to grid cells: scale about the origin, then translation by
/// `offset`.
struct Stretch {
    glm::dvec2 scale{0};
    glm::dvec2 offset{0};
};

/// Returns the transformation that maps `extent` to side x side grid cells, with a margin of 0.1% on each side. Both
/// scales are limited to `max`.
Stretch stretchOf(const Extent& extent, int side, double max) {
    Stretch stretch;
    stretch.scale = glm::min(side * 0.998 / (extent.max - extent.min), glm::dvec2(max));
    stretch.offset = glm::dvec2(side * 0.001) - extent.min * stretch.scale;
    return stretch;
}

glm::dmat3 matrixOf(const Stretch& stretch) {
    const glm::dvec2& scale = stretch.scale;
    return {glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(stretch.offset.x, stretch.offset.y, 1)};
}

GridMap mapOf(const glm::dmat4x3& plane, const Stretch& stretch, double minW) {
    return {matrixOf(stretch) * plane, minW / 2, false};
}

/// Returns the rounding error of a x + b y + c w, for weights (a, b, c). x, y and w are the plane coordinates of a
/// point whose (u, v, h) has an error of `coordinateError`. This error is at least 2^-50 of |u|, |v| and |h|, so the
/// seven roundings of each term are smaller than one more such error.
double errorOf(const glm::dmat4x3& plane, const glm::dvec3& weights, double coordinateError) {
    const auto size = [&](int column) {
        const glm::dvec3 terms = weights * plane[column];
        return std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z);
    };
    return 2 * coordinateError * (size(0) + size(1) + size(2)) + 0x1p-50 * size(3);
}

/// Returns the smallest w at which the rounding error of a caster's x and y is at most an eighth of kCellSlack. The
/// rest is for the errors of samples and of float copies. Returns infinity if an extent of 0 makes a scale invalid.
double minUsableW(const glm::dmat4x3& plane, const Stretch& stretch, int side, double coordinateError) {
    const double w = errorOf(plane, {0, 0, 1}, coordinateError);
    const double x = errorOf(plane, {stretch.scale.x, 0, stretch.offset.x}, coordinateError);
    const double y = errorOf(plane, {0, stretch.scale.y, stretch.offset.y}, coordinateError);
    return x == x && y == y ? (std::max(x, y) + side * w) * (8 / kCellSlack) : std::numeric_limits<double>::infinity();
}

/// Returns true if the warp of a map is usable. This requires that w varies by at most 2^20 over the samples, and that
/// x and y of casters are precise enough.
bool isUsable(
    const glm::dmat4x3& plane, const Extent& extent, const Stretch& stretch, int side, double coordinateError) {
    constexpr double kMaxVariation = 1 << 20;
    if (!(extent.minW > 0 && extent.maxW <= kMaxVariation * extent.minW)) return false;
    const double min = minUsableW(plane, stretch, side, coordinateError);
    return std::isfinite(min) && min <= extent.minW / 2;
}

/// Extends a homography of the light plane to points (u, v, h, 1). The result does not depend on h.
glm::dmat4x3 withoutHeight(const glm::dmat3& plane) {
    return {plane[0], plane[1], glm::dvec3(0), plane[2]};
}

/// Returns the projection from a point light at `light` through a face of the cube around it. Each face has two maps,
/// so the index of the face is `map` / 2. x / w and y / w are in [-1, 1]. w is the distance along the axis of the face,
/// which is (map / 2) % 3.
glm::dmat4x3 facePlane(const glm::dvec3& light, int map) {
    const int along = map / 2 % 3;
    const int first = (along + 1) % 3;
    const int second = (along + 2) % 3;
    const double sign = map % 2 == 0 ? 1 : -1;
    glm::dmat4x3 plane(0);
    plane[first].x = plane[second].y = 1;
    plane[along].z = sign;
    plane[3] = -glm::dvec3(light[first], light[second], sign * light[along]);
    return plane;
}

/// Returns the smallest height towards a point light of the samples [begin, end). Heights are along the axis of the
/// map's cube face.
double minNearness(const SampleList& samples, const GridMap& map, std::size_t begin, std::size_t end) {
    const FrameArray<double>& values = map.nearAxis == 0 ? samples.u : map.nearAxis == 1 ? samples.v : samples.h;
    if (map.nearSign > 0) return *std::min_element(&values[begin], &values[end]);
    return -*std::max_element(&values[begin], &values[end]);
}

} // namespace

void SampleGrid::sort(SampleList& samples, std::span<const glm::dmat3> planes, int side, double coordinateError) {
    side_ = side;
    size_ = samples.size();
    for (auto* values : {&triangle, &source})
        values->ensureCapacity(samples.u.size()); // padded, like the samples' arrays
    spare_.ensureCapacity(samples.u.size());      // the arrays are swapped
    fitMaps(samples, planes, coordinateError);
    countCells(samples);
    order(samples);
    maskAndBox(samples);
}

void SampleGrid::fitMaps(const SampleList& samples, std::span<const glm::dmat3> planes, double coordinateError) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (samples.space().pointLight) return fitPointMaps(samples, coordinateError);
    std::vector<glm::dmat4x3> used;
    used.reserve(planes.size());
    for (const glm::dmat3& plane : planes)
        used.push_back(withoutHeight(plane));
    const std::vector<Extent> extents = extentsOf(samples, used);
    maps_.assign(used.size(), {});
    bool isUnwarped = false;
    for (std::size_t map = 0; map < used.size(); ++map) {
        if (extents[map].samples == 0) continue;
        const Stretch stretch = stretchOf(extents[map], side_, kInfinite);
        if (isUsable(used[map], extents[map], stretch, side_, coordinateError)) {
            maps_[map] = mapOf(used[map], stretch, extents[map].minW);
        } else {
            used[map] = withoutHeight(glm::dmat3(1));
            isUnwarped = true;
        }
    }
    if (!isUnwarped) return;
    // The rounding error of x is at most 6 scale coordinateError. This is the result of errorOf if the offset is at
    // most 2^50 coordinateError scale.
    const double max = kCellSlack / 64 / coordinateError;
    const std::vector<Extent> plainExtents = extentsOf(samples, used);
    for (std::size_t map = 0; map < used.size(); ++map)
        if (extents[map].samples > 0 && maps_[map].isEmpty)
            maps_[map] = mapOf(used[map], stretchOf(plainExtents[map], side_, max), 1);
}

/// Computes the grid maps of a point light. Cells are so large that the rounding error of a sample's x and y stays
/// below the fraction of kCellSlack for samples. If even a cell of the size of the whole face is too small, all samples
/// of the face share one cell.
void SampleGrid::fitPointMaps(const SampleList& samples, double coordinateError) {
    const glm::dvec3 light(*samples.space().pointLight);
    const double farthestAlong = std::max({std::abs(light.x), std::abs(light.y), std::abs(light.z)});
    std::vector<glm::dmat4x3> used;
    used.reserve(kPointMaps);
    for (int map = 0; map < kPointMaps; ++map)
        used.push_back(facePlane(light, map));
    const std::vector<Extent> extents = extentsOf(samples, used);
    maps_.assign(used.size(), {});
    for (std::size_t map = 0; map < used.size(); ++map) {
        const Extent& extent = extents[map];
        if (extent.samples == 0) continue;
        const double error = 2 * coordinateError + 0x1p-50 * farthestAlong;
        const Stretch stretch = stretchOf(extent, side_, kCellSlack / 128 * extent.minW / error);
        // The slopes of a triangle are computed from points beside the face. If these points were too far away, the
        // rounding of doubles would exceed whole cells.
        const double farthest =
            std::max(stretch.scale.x, stretch.scale.y) * (coordinateError * 0x1p49 + farthestAlong) * 0x1p-36;
        const double minW = std::max(minUsableW(used[map], stretch, side_, coordinateError), farthest);
        GridMap& fitted = maps_[map];
        if (extent.minW > 0 && std::isfinite(minW) && minW <= extent.minW)
            fitted = {matrixOf(stretch) * used[map], minW, false};
        else
            fitted = {{glm::dvec3(0), glm::dvec3(0), glm::dvec3(0), glm::dvec3(0.5, 0.5, 1)}, 0.5, false};
        fitted.nearAxis = static_cast<int>(map) / 2 % 3;
        fitted.nearSign = map % 2 == 0 ? -1 : 1;
    }
}

void SampleGrid::countCells(const SampleList& samples) {
    constexpr std::size_t kRun = 512;
    constexpr std::size_t kPadding = 16;
    const std::size_t cells = maps_.size() * static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    first_.assign(cells + 1, 0);
    forChunks(size_, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::array<std::uint32_t, kRun + kPadding> found; // NOLINT(cppcoreguidelines-pro-type-member-init): filled
        for (std::size_t i = begin; i < end; i += kRun) {
            const SampleRun run{&samples, i, std::min(end, i + kRun)};
            for (std::size_t map = 0; map < maps_.size(); ++map)
                findCells(maps_[map].cellsFromLight, map, side_, run, found);
            for (std::size_t k = i; k < run.end; ++k) {
                const std::size_t at = cell(samples.mapOf(k), 0, 0) + found[k - i];
                const std::uint64_t rank = std::atomic_ref(first_[at]).fetch_add(1, std::memory_order_relaxed);
                spare_[k] = std::bit_cast<double>(std::uint64_t{at} << 32U | rank);
            }
        }
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_) {
        const std::uint32_t count = first;
        first = sum;
        sum += count;
    }
}

/// Sorts the arrays of `samples` one after another. Each array is sorted into the spare array, and its own memory
/// becomes the next spare array.
void SampleGrid::order(SampleList& samples) {
    forChunks(size_, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto cellAndRank = std::bit_cast<std::uint64_t>(spare_[i]);
            const std::size_t to = first_[cellAndRank >> 32U] + static_cast<std::uint32_t>(cellAndRank);
            source[to] = static_cast<std::uint32_t>(i);
            triangle[to] = samples.triangle[i];
        }
    });
    for (FrameArray<double>* values : {&samples.u, &samples.v, &samples.h}) {
        forChunks(size_, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t to = begin; to < end; ++to)
                spare_[to] = (*values)[source[to]];
        });
        values->swap(spare_);
    }
}

/// Divides the samples into ranges, and calls `visit` for all ranges in parallel.
void SampleGrid::forPieces(const std::function<void(Piece&)>& visit) {
    pieces_.clear();
    for (std::size_t begin = 0; begin < size_; begin += kChunk) {
        const auto cell = std::lower_bound(first_.begin(), first_.end(), begin);
        pieces_.push_back({begin, std::min(size_, begin + kChunk), static_cast<std::size_t>(cell - first_.begin()), 0});
    }
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) { visit(pieces_[i]); });
}

/// Moves the remaining samples together after a removal. Reduces the first sample index of each cell by the number of
/// removed samples before the cell.
void SampleGrid::closeGaps(SampleList& samples, FrameArray<std::uint8_t>& statuses) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const std::size_t endCell = i + 1 < pieces_.size() ? pieces_[i + 1].firstCell : first_.size();
        const auto gap = static_cast<std::uint32_t>(pieces_[i].begin - size);
        for (std::size_t cell = pieces_[i].firstCell; cell < endCell; ++cell)
            if (first_[cell] < size_) first_[cell] -= gap;
        size += pieces_[i].kept;
    }
    const auto close = [&](auto& values) {
        auto* to = &values[0];
        for (const Piece& piece : pieces_)
            to = std::copy_n(&values[piece.begin], piece.kept, to);
    };
    tbb::parallel_invoke(
        [&] { close(samples.u); },
        [&] { close(samples.v); },
        [&] { close(samples.h); },
        [&] { close(triangle); },
        [&] { close(source); },
        [&] { close(statuses); });
    for (std::size_t cell = first_.size(); cell > 0 && first_[cell - 1] >= size_; --cell)
        first_[cell - 1] = static_cast<std::uint32_t>(size);
    size_ = size;
}

void SampleGrid::maskAndBox(const SampleList& samples) {
    if (!samples.space().pointLight) blocks_.fit(samples, size_);
    masks_.resize(maps_.size());
    for (std::size_t map = 0; map < maps_.size(); ++map) {
        ReceiverMask& mask = masks_[map];
        mask.reset(side_, side_);
        if (maps_[map].isEmpty) continue;
        tbb::parallel_for(0, mask.blocksHigh(), [&](int row) {
            const int lastRow = std::min(side_, (row + 1) << ReceiverMask::kBlockBits);
            for (int y = row << ReceiverMask::kBlockBits; y < lastRow; ++y)
                for (int block = 0; block < mask.blocksWide(); ++block) {
                    const std::size_t begin = first_[cell(map, block << ReceiverMask::kBlockBits, y)];
                    const int next = std::min(side_, (block + 1) << ReceiverMask::kBlockBits);
                    const std::size_t end = first_[cell(map, next, y)];
                    if (begin == end) continue;
                    const double min = minNearness(samples, maps_[map], begin, end);
                    float& lowest = mask.lowest(block, row);
                    lowest = std::min(lowest, roundedDown(min));
                }
        });
        mask.finish();
    }
}

} // namespace gnomon::exact
