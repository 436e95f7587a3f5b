#include "executor/overlay/upscaled.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace gnomon::executor {

namespace {

constexpr int kOne = 256; // of a weight

/// Between which two of `count` places place `at` of `wanted` lies, and how near to the second.
struct Between {
    int first = 0;
    int second = 0;
    std::uint32_t weight = 0; // of the second, of kOne

    Between(int at, int count, int wanted) {
        const double place = std::clamp((at + 0.5) * count / wanted - 0.5, 0.0, static_cast<double>(count - 1));
        first = static_cast<int>(place);
        second = std::min(first + 1, count - 1);
        weight = static_cast<std::uint32_t>(std::lround((place - first) * kOne));
    }
};

/// The mix of all four bytes of two pixels, two of them in a multiplication: no sum is wider than 16 bits.
std::uint32_t mixed(std::uint32_t first, std::uint32_t second, std::uint32_t weight) {
    constexpr std::uint32_t kEven = 0x00FF00FF;
    constexpr std::uint32_t kHalves = 0x00800080;
    const std::uint32_t left = kOne - weight;
    const std::uint32_t even = (first & kEven) * left + (second & kEven) * weight + kHalves;
    const std::uint32_t odd = (first >> 8U & kEven) * left + (second >> 8U & kEven) * weight + kHalves;
    return (even >> 8U & kEven) | (odd & ~kEven);
}

using Pixels = std::vector<std::uint32_t>;

/// The pixels of one row.
void takeRow(const Picture& picture, int y, Pixels& row) {
    const Rgb* from = &picture.at(0, y);
    for (std::size_t x = 0; x < row.size(); ++x)
        row[x] = std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{from[x][0], from[x][1], from[x][2], 255});
}

} // namespace

WindowPicture upscaled(const Picture& picture, int width, int height) {
    std::vector<Between> places;
    places.reserve(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
        places.emplace_back(x, picture.width, width);
    WindowPicture result(width, height);
    constexpr int kRows = 32;
    tbb::parallel_for(tbb::blocked_range<int>(0, height, kRows), [&](const auto& rows) {
        const auto narrow = static_cast<std::size_t>(picture.width);
        Pixels upper(narrow);
        Pixels lower(narrow);
        Pixels row(narrow);
        int held = -1; // the row that `upper` is
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const Between place(y, picture.height, height);
            if (place.first != held) {
                takeRow(picture, place.first, upper);
                takeRow(picture, place.second, lower);
                held = place.first;
            }
            for (std::size_t x = 0; x < narrow; ++x)
                row[x] = mixed(upper[x], lower[x], place.weight);
            std::array<std::uint8_t, 4>* to = &result.at(0, y);
            for (std::size_t x = 0; x < places.size(); ++x) {
                const Between& between = places[x];
                to[x] = std::bit_cast<std::array<std::uint8_t, 4>>(mixed(
                    row[static_cast<std::size_t>(between.first)],
                    row[static_cast<std::size_t>(between.second)],
                    between.weight));
            }
        }
    });
    return result;
}

} // namespace gnomon::executor
