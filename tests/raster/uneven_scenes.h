// Unevenly spaced rows, and depths drawn on them, compared with simple code.
#pragma once

#include "raster/raster.h"

#include <span>
#include <utility>
#include <vector>

namespace gnomon::raster {

/// Returns rows evenly spaced in the logarithm of -y / w, from -1 to -1 / ratio.
std::vector<float> logarithmicRows(int count, double ratio);

std::vector<float> evenRows(int count);

/// Returns rows with random gaps, up to 5.7 times as wide as their neighbours. Their density grows by about `ratio`.
std::vector<float> randomRows(int count, double ratio, std::uint64_t seed);

/// Returns the kinds of rows that each scene is drawn on, with names.
std::vector<std::pair<const char*, std::vector<float>>> kindsOfRows(int count);

struct DrawnDepths {
    std::vector<float> depths;
    std::uint64_t fragments = 0;
};

DrawnDepths drawn(std::span<const Cluster> clusters, const View& view, int width, int height);

/// The simple result: nearest depths, and the number of covers per sample.
struct PlainDepths {
    std::vector<double> depths;
    std::vector<int> covers;
    std::uint64_t fragments = 0;
};

PlainDepths plainly(std::span<const Cluster> clusters, const View& view, int width, int height);

/// Expects the same samples as simple code, with depths within `slack`, on all instruction sets and with one and two
/// threads.
void expectAsPlain(std::span<const Cluster> clusters, const View& view, int width, int height, double slack);

} // namespace gnomon::raster
