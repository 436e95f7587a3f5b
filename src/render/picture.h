// Pictures in memory and on disk: PNG for viewing, PFM for measurements.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::render {

/// A colour for display with 8 bits per channel.
using Rgb = std::array<std::uint8_t, 3>;

/// A 2D array of pixels, row by row from top to bottom.
template <class Pixel>
struct Raster {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;

    Raster() = default;

    Raster(int w, int h, const Pixel& fill = {})
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }

    const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }

    Pixel& at(int x, int y) { return pixels[index(x, y)]; }
};

using Picture = Raster<Rgb>;
using FloatPicture = Raster<float>;

/// The coverage (opacity) of each pixel, where 255 is full coverage. A picture without coverage is opaque.
using Coverage = Raster<std::uint8_t>;

/// Encodes `picture` as a PNG file, with `coverage` as alpha channel. Throws Error if the encoding fails.
std::vector<std::uint8_t> pngBytes(const Picture& picture, const std::optional<Coverage>& coverage = std::nullopt);

/// Writes `picture` as an 8-bit RGB PNG, or as RGBA if `coverage` is given. The file appears under `path` only when it
/// is complete. Throws Error if writing fails.
void writePng(const std::string& path, const Picture& picture, const std::optional<Coverage>& coverage = std::nullopt);

/// Returns the coverage of each pixel: full for a finite `depth`, otherwise 0.
Coverage coverageOf(const FloatPicture& depth);

/// Reads a PNG file as 8-bit RGB and ignores transparency. Throws Error if the file is not a valid PNG.
Picture readPng(const std::string& path);

/// Writes `picture` as a one-channel little-endian PFM file, with rows from bottom to top. Throws Error if writing
/// fails.
void writePfm(const std::string& path, const FloatPicture& picture);

/// The difference of two pictures. All values are fractions of full scale.
struct PictureDifference {
    double mean = 0;            // mean absolute difference over all pixels and channels
    double largest = 0;         // largest difference of a channel
    double changedFraction = 0; // fraction of pixels that differ by more than 2 of 255 levels in some channel
};

/// Computes the difference of pictures `a` and `b`. Throws Error if their sizes differ.
PictureDifference difference(const Picture& a, const Picture& b);

/// A picture and the path of its file.
struct NamedPicture {
    std::string path;
    Picture picture;
};

/// Throws Error if `picture` differs too much from `reference`. `threshold` is the max mean difference, as a fraction
/// of full scale.
void requireAlike(const NamedPicture& reference, const Picture& picture, double threshold);

} // namespace gnomon::render
