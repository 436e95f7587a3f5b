#include "exact/sample_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {

namespace {

constexpr std::size_t kChunk = 16384;

/// Calls `visit(begin, end, chunk)` for pieces of [0, size) in parallel.
template <class Visit>
void forChunks(std::size_t size, const Visit& visit) {
    const std::size_t chunks = (size + kChunk - 1) / kChunk;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        visit(chunk * kChunk, std::min(size, (chunk + 1) * kChunk), chunk);
    });
}

/// What the samples of a map span.
struct Extent {
    double leastW = std::numeric_limits<double>::infinity();
    double mostW = -std::numeric_limits<double>::infinity();
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        leastW = std::min(leastW, p.z);
        mostW = std::max(mostW, p.z);
        const glm::dvec2 place = glm::dvec2(p) / p.z;
        least = glm::min(least, place);
        most = glm::max(most, place);
    }

    void add(const Extent& other) {
        leastW = std::min(leastW, other.leastW);
        mostW = std::max(mostW, other.mostW);
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }
};

std::vector<Extent> extentsOf(const SampleList& samples, std::span<const glm::dmat3> planes) {
    std::vector<std::vector<Extent>> parts((samples.size() + kChunk - 1) / kChunk);
    forChunks(samples.size(), [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::vector<Extent> extents(planes.size());
        for (std::size_t i = begin; i < end; ++i) {
            const auto map = static_cast<std::size_t>(samples.map[i]);
            extents[map].add(planes[map] * glm::dvec3(samples.u[i], samples.v[i], 1));
        }
        parts[chunk] = std::move(extents);
    });
    std::vector<Extent> result(planes.size());
    for (const std::vector<Extent>& part : parts)
        for (std::size_t map = 0; map < part.size(); ++map)
            result[map].add(part[map]);
    return result;
}

/// Whether divisions by w are exact enough, and cells spread evenly enough, for the warp to be of use.
bool isUsable(const Extent& extent) {
    constexpr double kMostVariation = 1 << 20;
    return extent.leastW > 0 && extent.mostW <= kMostVariation * extent.leastW;
}

/// Stretches `plane` so that `extent` fills side x side cells but for a thousandth on each side; but cells stay large
/// against the rounding of coordinates.
CellMap fitted(const glm::dmat3& plane, const Extent& extent, int side) {
    constexpr double kLeastRelative = 1e-9;
    constexpr double kLeast = 1e-30;
    const double inside = side * 0.998;
    glm::dvec2 scale;
    for (int i = 0; i < 2; ++i) {
        const double farthest = std::max(std::abs(extent.least[i]), std::abs(extent.most[i]));
        scale[i] = inside / std::max({extent.most[i] - extent.least[i], kLeastRelative * farthest, kLeast});
    }
    const glm::dvec2 offset = glm::dvec2(side * 0.001) - extent.least * scale;
    const glm::dmat3 stretch(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(offset.x, offset.y, 1));
    return {stretch * plane, extent.leastW / 2, false};
}

/// The greatest float that is not above `value`.
float roundedDown(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest <= value ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

} // namespace

void SampleGrid::sort(const SampleList& samples, std::span<const glm::dmat3> planes, int side) {
    side_ = side;
    size_ = samples.size();
    fitMaps(samples, planes);
    countCells(samples);
    scatter(samples);
    maskReceivers();
}

void SampleGrid::fitMaps(const SampleList& samples, std::span<const glm::dmat3> planes) {
    std::vector<glm::dmat3> used(planes.begin(), planes.end());
    std::vector<Extent> extents = extentsOf(samples, used);
    const auto isWrong = [](const Extent& extent) { return extent.mostW >= extent.leastW && !isUsable(extent); };
    if (std::any_of(extents.begin(), extents.end(), isWrong)) {
        for (std::size_t map = 0; map < used.size(); ++map)
            if (isWrong(extents[map])) used[map] = glm::dmat3(1);
        extents = extentsOf(samples, used);
    }
    maps_.assign(used.size(), {});
    for (std::size_t map = 0; map < used.size(); ++map)
        if (extents[map].mostW >= extents[map].leastW) maps_[map] = fitted(used[map], extents[map], side_);
}

void SampleGrid::countCells(const SampleList& samples) {
    const std::size_t cells = maps_.size() * static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
    first_.assign(cells + 1, 0);
    cellOf_.resize(size_);
    rankOf_.resize(size_);
    forChunks(size_, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto map = static_cast<std::size_t>(samples.map[i]);
            const glm::dvec3 p = maps_[map].cellsFromLightPlane * glm::dvec3(samples.u[i], samples.v[i], 1);
            const std::size_t at = cell(map, cellAt(p.x / p.z, side_), cellAt(p.y / p.z, side_));
            cellOf_[i] = static_cast<std::uint32_t>(at);
            rankOf_[i] = std::atomic_ref(first_[at]).fetch_add(1, std::memory_order_relaxed);
        }
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_) {
        const std::uint32_t count = first;
        first = sum;
        sum += count;
    }
}

void SampleGrid::scatter(const SampleList& samples) {
    constexpr std::size_t kPadding = 16;
    if (u.size() < size_ + kPadding) {
        for (auto* values : {&u, &v, &h})
            values->resize(size_ + kPadding);
        tolerance.resize(size_ + kPadding);
        triangle.resize(size_ + kPadding);
        source.resize(size_ + kPadding);
    }
    forChunks(size_, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t to = first_[cellOf_[i]] + rankOf_[i];
            u[to] = samples.u[i];
            v[to] = samples.v[i];
            h[to] = samples.h[i];
            tolerance[to] = samples.tolerance[i];
            triangle[to] = samples.triangle[i];
            source[to] = static_cast<std::uint32_t>(i);
        }
    });
}

void SampleGrid::maskReceivers() {
    masks_.resize(maps_.size());
    for (std::size_t map = 0; map < maps_.size(); ++map) {
        ReceiverMask& mask = masks_[map];
        mask.reset(side_, side_);
        if (maps_[map].isEmpty) continue;
        tbb::parallel_for(0, mask.blocksHigh(), [&](int row) {
            const int end = std::min(side_, (row + 1) << ReceiverMask::kBlockBits);
            for (int y = row << ReceiverMask::kBlockBits; y < end; ++y)
                for (int x = 0; x < side_; ++x) {
                    const std::size_t at = cell(map, x, y);
                    float& lowest = mask.lowest(x >> ReceiverMask::kBlockBits, row);
                    for (std::uint32_t i = first_[at]; i < first_[at + 1]; ++i)
                        lowest = std::min(lowest, roundedDown(h[i]));
                }
        });
        mask.finish();
    }
}

} // namespace gnomon::exact
