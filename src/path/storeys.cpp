#include "path/storeys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace gnomon::path {

namespace {

constexpr double kSmallest = 36; // min area of a storey, in squared eye heights: 104 square metres

/// Returns the connected components of the walkable floor that is below a ceiling.
std::vector<std::vector<std::uint32_t>> roomsOf(const WalkableFloor& floor) {
    std::vector<std::vector<std::uint32_t>> rooms;
    std::vector<bool> isSeen(floor.cells().size(), false);
    for (std::uint32_t first = 0; first < floor.cells().size(); ++first) {
        if (isSeen[first] || !floor.isWalkable(first) || !floor.isInside(first)) continue;
        std::vector<std::uint32_t>& room = rooms.emplace_back(1, first);
        isSeen[first] = true;
        for (std::size_t i = 0; i < room.size(); ++i)
            for (const std::uint32_t next : floor.cells()[room[i]].next) {
                if (next == FloorCell::kNone || isSeen[next] || !floor.isWalkable(next) || !floor.isInside(next))
                    continue;
                isSeen[next] = true;
                room.push_back(next);
            }
    }
    return rooms;
}

} // namespace

std::vector<Storey> findStoreys(const WalkableFloor& floor) {
    const ColumnGrid& grid = floor.grid();
    const double eyeHeight = floor.body().eyeHeight;
    const double cellArea = grid.cell * grid.cell;
    const double aRoom = kSmallest * eyeHeight * eyeHeight;
    std::vector<std::vector<std::uint32_t>> rooms = roomsOf(floor);
    double largest = 0;
    for (const auto& room : rooms)
        largest = std::max(largest, static_cast<double>(room.size()) * cellArea);
    std::map<std::int32_t, double> areas; // by height in steps
    for (const auto& room : rooms)
        if (static_cast<double>(room.size()) * cellArea >= std::min(aRoom, 0.25 * largest))
            for (const std::uint32_t cell : room)
                areas[floor.cells()[cell].floor] += cellArea;

    const auto near = std::max(1, static_cast<std::int32_t>(0.12 * eyeHeight / grid.rise));
    const auto apart = static_cast<std::int32_t>(1.1 * eyeHeight / grid.rise);
    std::vector<Storey> peaks;
    for (const auto& area : areas) {
        const std::int32_t height = area.first;
        Storey storey{static_cast<double>(height), 0};
        double maxValue = 0; // area at the height with the largest area, which becomes the height of the storey
        for (auto i = areas.lower_bound(height - near); i != areas.end() && i->first <= height + near; ++i) {
            storey.area += i->second;
            if (i->second <= maxValue) continue;
            maxValue = i->second;
            storey.height = i->first;
        }
        peaks.push_back(storey);
    }
    std::stable_sort(peaks.begin(), peaks.end(), [](const Storey& a, const Storey& b) { return a.area > b.area; });
    std::vector<Storey> storeys;
    for (const Storey& peak : peaks) {
        const double minArea = std::min(aRoom, 0.25 * peaks.front().area);
        if (peak.area < minArea) break;
        const auto isNear = [&](const Storey& other) { return std::abs(other.height - peak.height) < apart; };
        if (std::none_of(storeys.begin(), storeys.end(), isNear)) storeys.push_back(peak);
    }
    std::sort(storeys.begin(), storeys.end(), [](const Storey& a, const Storey& b) { return a.height < b.height; });
    for (Storey& storey : storeys)
        storey.height = floor.height(static_cast<std::int32_t>(storey.height));
    return storeys;
}

HeightBand bandOf(const std::vector<Storey>& storeys, std::size_t index, const WalkBody& body) {
    HeightBand band{storeys[index].height - 2 * body.step, storeys[index].height + 0.5 * body.eyeHeight};
    if (index + 1 < storeys.size()) band.high = std::min(band.high, storeys[index + 1].height - 2 * body.step);
    return band;
}

std::string listOf(const std::vector<Storey>& storeys) {
    std::string list;
    for (std::size_t i = 0; i < storeys.size(); ++i) {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), "%s%zu (at %.4g)", i > 0 ? ", " : "", i, storeys[i].height);
        list += text.data();
    }
    return list.empty() ? "none" : list;
}

} // namespace gnomon::path
