// Decodes PNG and JPEG images.
#pragma once

#include "preprocess/read/gltf/memory_room.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// An image in RGBA8, red first, rows from the top.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// Decodes the PNG or JPEG in `encoded` by libpng or libjpeg-turbo. Converts a CMYK JPEG to RGB without a colour
/// profile. Throws Error at `where` if the image is neither PNG nor JPEG, is damaged, has too many scans, or needs more
/// memory than `room` has.
DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where);

} // namespace gnomon::read
