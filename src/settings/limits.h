// The ends of what settings may be.
#pragma once

#include <cstdint>

namespace gnomon::settings {

/// The most slices that can be asked for: with five faces each, the tree is asked for at most 60 caster volumes at
/// once.
constexpr int kMaxSlices = 12;

constexpr int kMaxSide = 16384; // of an image and of the texture of all maps: what every executor can draw
constexpr std::int64_t kMaxShadowTexels = std::int64_t{kMaxSide} * kMaxSide;
constexpr int kMaxFilter = 16; // texels

/// The least and the most that the window offers.
constexpr double kLeastOfferedErrorPixels = 0.125;
constexpr double kMostOfferedErrorPixels = 64;
constexpr int kLeastOfferedTexels = 256; // a side
constexpr int kMostOfferedTexels = 8192;

} // namespace gnomon::settings
