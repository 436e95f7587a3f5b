#include "executor/picture.h"

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <png.h>

namespace gnomon::executor {

namespace {

std::string sizeText(const Picture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

} // namespace

std::vector<std::uint8_t> pngBytes(const Picture& picture, const std::optional<Coverage>& coverage) {
    const void* pixels = picture.pixels.data();
    std::vector<std::array<std::uint8_t, 4>> withAlpha;
    if (coverage) {
        GNOMON_CHECK_OP(coverage->pixels.size(), ==, picture.pixels.size());
        withAlpha.reserve(picture.pixels.size());
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const Rgb& color = picture.pixels[i];
            withAlpha.push_back({color[0], color[1], color[2], coverage->pixels[i]});
        }
        pixels = withAlpha.data();
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = coverage ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    if (png_image_write_to_memory(&image, nullptr, &size, 0, pixels, 0, nullptr) == 0)
        throw Error(std::string("a picture cannot be written as PNG: ") + image.message);
    std::vector<std::uint8_t> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
        throw Error(std::string("a picture cannot be written as PNG: ") + image.message);
    bytes.resize(size);
    return bytes;
}

void writePng(const std::string& path, const Picture& picture, const std::optional<Coverage>& coverage) {
    AtomicFile file(path);
    file.file().writeAt(0, std::as_bytes(std::span<const std::uint8_t>(pngBytes(picture, coverage))));
    file.commit();
}

Coverage coverageOf(const FloatPicture& depth) {
    Coverage coverage(depth.width, depth.height);
    for (std::size_t i = 0; i < depth.pixels.size(); ++i)
        if (std::isfinite(depth.pixels[i])) coverage.pixels[i] = 255;
    return coverage;
}

Picture readPng(const std::string& path) {
    const std::string text = readTextFile(path);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, text.data(), text.size()) == 0)
        throw Error(path, std::string("cannot be read as PNG: ") + image.message);
    image.format = PNG_FORMAT_RGB;
    Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
    const bool done = png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) != 0;
    png_image_free(&image);
    if (!done) throw Error(path, std::string("cannot be read as PNG: ") + image.message);
    return picture;
}

void writePfm(const std::string& path, const FloatPicture& picture) {
    static_assert(std::endian::native == std::endian::little, "the header below says little-endian");
    const std::string header =
        "Pf\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
    const std::size_t rowBytes = static_cast<std::size_t>(picture.width) * sizeof(float);
    std::vector<std::byte> bytes(header.size() + rowBytes * static_cast<std::size_t>(picture.height));
    std::memcpy(bytes.data(), header.data(), header.size());
    std::byte* row = bytes.data() + header.size();
    for (int y = picture.height - 1; y >= 0; --y, row += rowBytes)
        std::memcpy(row, picture.pixels.data() + picture.index(0, y), rowBytes);
    AtomicFile file(path);
    file.file().writeAt(0, bytes);
    file.commit();
}

PictureDifference difference(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error("pictures", "they differ in size", sizeText(a), sizeText(b));
    constexpr int kVisibleLevels = 2;
    std::uint64_t sum = 0;
    int largest = 0;
    std::uint64_t changed = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]});
            sum += static_cast<std::uint64_t>(apart);
            worst = std::max(worst, apart);
        }
        largest = std::max(largest, worst);
        changed += worst > kVisibleLevels ? 1U : 0U;
    }
    const auto count = static_cast<double>(a.pixels.size());
    return {static_cast<double>(sum) / (count * 3 * 255), largest / 255.0, static_cast<double>(changed) / count};
}

void requireAlike(const NamedPicture& reference, const Picture& picture, double threshold) {
    const double found = difference(reference.picture, picture).mean;
    if (found > threshold)
        throw Error(
            reference.path,
            "the picture differs from its reference",
            "a mean difference of at most " + std::to_string(threshold),
            std::to_string(found));
}

} // namespace gnomon::executor
