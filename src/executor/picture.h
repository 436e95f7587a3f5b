// Pictures in memory and on disk: PNG for what is looked at, PFM for what is measured.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::executor {

/// A pixel, 8 bits a channel, display-referred.
using Rgb = std::array<std::uint8_t, 3>;

/// Rows from top to bottom.
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

/// How much of each pixel is covered, 255 being all of it; where a picture has none it is opaque.
using Coverage = Raster<std::uint8_t>;

/// `picture` as the bytes of a PNG file, with `coverage` as its alpha. Throws Error.
std::vector<std::uint8_t> pngBytes(const Picture& picture, const std::optional<Coverage>& coverage = std::nullopt);

/// Writes an 8-bit RGB PNG, or RGBA with `coverage`; it appears under `path` only when it is complete. Throws Error.
void writePng(const std::string& path, const Picture& picture, const std::optional<Coverage>& coverage = std::nullopt);

/// Covered where `depth` is finite.
Coverage coverageOf(const FloatPicture& depth);

/// Reads a PNG as 8-bit RGB, any transparency dropped. Throws Error if it is none or damaged.
Picture readPng(const std::string& path);

/// Writes a one-channel little-endian PFM (rows from bottom to top, as that format has them). Throws Error.
void writePfm(const std::string& path, const FloatPicture& picture);

/// How two pictures differ, in fractions of full scale.
struct PictureDifference {
    double mean = 0;            // mean absolute difference over all pixels and channels
    double largest = 0;         // the largest of any channel
    double changedFraction = 0; // pixels any of whose channels differ by more than 2 of 255 levels
};

/// Throws Error if the sizes differ.
PictureDifference difference(const Picture& a, const Picture& b);

/// A picture and the file that it was read from.
struct NamedPicture {
    std::string path;
    Picture picture;
};

/// Throws Error if `picture` differs from `reference` by a mean of more than `threshold`, a fraction of full scale.
void requireAlike(const NamedPicture& reference, const Picture& picture, double threshold);

} // namespace gnomon::executor
