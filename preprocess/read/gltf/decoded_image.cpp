#include "preprocess/read/gltf/decoded_image.h"

#include "core/error.h"
#include "core/printable.h"

#include <algorithm>
#include <array>
#include <memory>

#include <png.h>
#include <turbojpeg.h>

namespace gnomon::read {

namespace {

bool beginsWith(std::span<const std::byte> bytes, std::span<const std::uint8_t> magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(), [](std::uint8_t a, std::byte b) {
               return std::byte{a} == b;
           });
}

void sizeFor(DecodedImage& image, MemoryRoom& room) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    room.take(pixels, 4);
    image.pixels.resize(pixels * 4);
}

DecodedImage decodedPng(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    const auto freed = [](png_image* image) { png_image_free(image); };
    const std::unique_ptr<png_image, decltype(freed)> keeper(&header, freed);
    const auto require = [&](int isGood) {
        if (isGood == 0) throw Error(where, "the PNG is damaged: " + printable(std::string_view(header.message)));
    };
    require(png_image_begin_read_from_memory(&header, encoded.data(), encoded.size()));
    header.format = PNG_FORMAT_RGBA;
    DecodedImage image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
    sizeFor(image, room);
    require(png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr));
    return image;
}

DecodedImage decodedJpeg(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    const auto freed = [](void* handle) { tjDestroy(handle); };
    const std::unique_ptr<void, decltype(freed)> reader(tjInitDecompress(), freed);
    const auto require = [&](int failed) {
        if (failed != 0)
            throw Error(where, "the JPEG is damaged: " + printable(std::string_view(tjGetErrorStr2(reader.get()))));
    };
    if (!reader) throw Error(where, "the JPEG cannot be read: no memory for its reader");
    const auto* bytes = reinterpret_cast<const unsigned char*>(encoded.data());
    DecodedImage image;
    int subsampling = 0;
    int colors = 0;
    require(
        tjDecompressHeader3(reader.get(), bytes, encoded.size(), &image.width, &image.height, &subsampling, &colors));
    sizeFor(image, room);
    require(tjDecompress2(
        reader.get(), bytes, encoded.size(), image.pixels.data(), image.width, 0, image.height, TJPF_RGBA, 0));
    return image;
}

} // namespace

DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    constexpr std::array<std::uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
    constexpr std::array<std::uint8_t, 3> kJpeg = {0xFF, 0xD8, 0xFF};
    if (beginsWith(encoded, kPng)) return decodedPng(encoded, room, where);
    if (beginsWith(encoded, kJpeg)) return decodedJpeg(encoded, room, where);
    throw Error(where, "not an image that can be read", "a PNG or a JPEG", "something else");
}

} // namespace gnomon::read
