#include "executor/overlay/upscaled.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::executor {

namespace {

constexpr int kOne = 256; // of a weight

/// Between which two of `count` places place `at` of `wanted` lies, and how near to the second.
struct Between {
    int first = 0;
    int second = 0;
    int weight = 0; // of the second, of kOne

    Between(int at, int count, int wanted) {
        const double place = std::clamp((at + 0.5) * count / wanted - 0.5, 0.0, static_cast<double>(count - 1));
        first = static_cast<int>(place);
        second = std::min(first + 1, count - 1);
        weight = static_cast<int>(std::lround((place - first) * kOne));
    }
};

std::uint8_t mixed(int first, int second, int weight) {
    return static_cast<std::uint8_t>((first * (kOne - weight) + second * weight + kOne / 2) / kOne);
}

/// Rows of `picture`, each as wide as is wanted.
Picture widened(const Picture& picture, int width) {
    Picture wide(width, picture.height);
    std::vector<Between> places;
    places.reserve(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
        places.emplace_back(x, picture.width, width);
    tbb::parallel_for(tbb::blocked_range<int>(0, picture.height, 16), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const Rgb* from = &picture.at(0, y);
            Rgb* to = &wide.at(0, y);
            for (std::size_t x = 0; x < places.size(); ++x) {
                const Between& place = places[x];
                for (std::size_t c = 0; c < 3; ++c)
                    to[x][c] = mixed(from[place.first][c], from[place.second][c], place.weight);
            }
        }
    });
    return wide;
}

} // namespace

Picture upscaled(const Picture& picture, int width, int height) {
    const Picture wide = widened(picture, width);
    Picture result(width, height);
    tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y) {
            const Between place(y, picture.height, height);
            const std::uint8_t* first = wide.at(0, place.first).data();
            const std::uint8_t* second = wide.at(0, place.second).data();
            std::uint8_t* to = result.at(0, y).data();
            for (int i = 0; i < 3 * width; ++i)
                to[i] = mixed(first[i], second[i], place.weight);
        }
    });
    return result;
}

} // namespace gnomon::executor
