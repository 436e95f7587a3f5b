// Small scenes in an orthographic view of 64x64 pixels, and the depths that the rasteriser draws.
#pragma once

#include "tests/raster/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace gnomon::raster {

constexpr int kFlatSide = 64;
constexpr PixelBox kFlatViewport = {0, 0, kFlatSide, kFlatSide};
using Position = std::array<std::uint32_t, 3>;

/// Returns a position from pixels of the flat view and a depth.
inline Position at(double x, double y, double depth) {
    const auto cells = [](double units) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(kSceneCenter) + std::llround(units));
    };
    return {cells(x * kFlatPixel), cells(y * kFlatPixel), cells(depth * 0x1p20)};
}

inline std::size_t pixelIndex(int x, int y) {
    return static_cast<std::size_t>(y) * kFlatSide + static_cast<std::size_t>(x);
}

inline std::vector<float> flatDepths(const Scene& scene, const View& view = flatView(kFlatViewport)) {
    std::vector<float> depths(std::size_t{kFlatSide} * kFlatSide);
    Rasterizer().drawDepth(scene.clusters(), view, {depths.data(), kFlatSide, kFlatSide});
    return depths;
}

inline std::vector<float> flatDepths(const Position& a, const Position& b, const Position& c) {
    Scene scene;
    scene.add({a, b, c}, {{0, 1, 2}});
    return flatDepths(scene);
}

/// Returns the number of covered pixels.
inline std::size_t covered(const std::vector<float>& depths) {
    return static_cast<std::size_t>(std::count_if(depths.begin(), depths.end(), [](float d) { return d < 1; }));
}

} // namespace gnomon::raster
