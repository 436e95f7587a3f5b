// The min and max values of settings.
#pragma once

#include <cstdint>

namespace gnomon::settings {

/// The max number of slices (parts of the view between two depths). A slice has at most five face partitions, so one
/// traversal of the hierarchy tests at most 60 volumes of shadow casters.
constexpr int kMaxSlices = 12;

constexpr int kMaxSide =
    16384; // pixels per side of an image, and texels per side of the shadow texture; all backends can draw it
constexpr std::int64_t kMaxShadowTexels = std::int64_t{kMaxSide} * kMaxSide;
constexpr int kMaxFilter = 16; // texels

/// The min and max values that the controls of the window offer.
constexpr double kMinOfferedErrorPixels = 0.125;
constexpr double kMaxOfferedErrorPixels = 64;
constexpr int kMinOfferedTexels = 256; // per side
constexpr int kMaxOfferedTexels = 8192;

} // namespace gnomon::settings
