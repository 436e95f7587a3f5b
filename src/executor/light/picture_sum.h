// Pictures added up in linear light: what antialiasing, and all else that is a mean of frames, comes to.
#pragma once

#include "executor/picture.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::executor {

/// A sum of pictures of one size. Each displayed byte counts as the linear light that it stands for, in 65,535ths of
/// full scale, so sums are whole numbers: no order and no number of threads changes them. Only the mean is rounded to
/// what a screen shows.
class PictureSum {
public:
    static constexpr int kMost = 65535; // pictures: their sum still fits

    /// Begins anew with nothing.
    void reset();

    /// Adds one more, at most kMost in all and of the size of the first. With `coverage` only pixels that are covered
    /// count, there 255; all pictures have one, or none has.
    void add(const Picture& picture, const std::optional<Coverage>& coverage = std::nullopt);

    int count() const { return count_; }

    /// The nearest byte of the mean light of each channel; over the pictures that cover the pixel, black where none
    /// does. Of equal pictures it is each of them. At least one picture.
    Picture mean() const;

    /// The share of the pictures that cover each pixel; nothing without coverage.
    std::optional<Coverage> coverage() const;

private:
    using Sums = std::array<std::uint32_t, 3>;

    int count_ = 0;
    Raster<Sums> sums_;
    Raster<std::uint16_t> covered_; // by how many; empty without coverage
};

} // namespace gnomon::executor
