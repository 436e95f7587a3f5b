// Rows that lie unevenly, and depths drawn on them beside plain ones.
#pragma once

#include "raster/raster.h"

#include <span>
#include <utility>
#include <vector>

namespace gnomon::raster {

/// Rows evenly in the logarithm of -y / w, from -1 to -1 / ratio.
std::vector<float> logarithmicRows(int count, double ratio);

std::vector<float> evenRows(int count);

/// Gaps at random, up to 5.7 times as wide as a neighbour, whose density grows by about `ratio`.
std::vector<float> randomRows(int count, double ratio, std::uint64_t seed);

/// Names the kinds of rows that every scene is drawn on.
std::vector<std::pair<const char*, std::vector<float>>> kindsOfRows(int count);

struct DrawnDepths {
    std::vector<float> depths;
    std::uint64_t fragments = 0;
};

DrawnDepths drawn(std::span<const Cluster> clusters, const View& view, int width, int height);

/// The plain answer: least depths, and how often each sample is covered.
struct PlainDepths {
    std::vector<double> depths;
    std::vector<int> covers;
    std::uint64_t fragments = 0;
};

PlainDepths plainly(std::span<const Cluster> clusters, const View& view, int width, int height);

/// Expects the same samples as plain code, and depths within `slack`, on every instruction set and one or two threads.
void expectAsPlain(std::span<const Cluster> clusters, const View& view, int width, int height, double slack);

} // namespace gnomon::raster
