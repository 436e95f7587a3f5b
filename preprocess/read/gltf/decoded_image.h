// A PNG or a JPEG as pixels.
#pragma once

#include "preprocess/read/gltf/memory_room.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// RGBA8, red first, rows from the top.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// Decodes the image in `encoded` by libpng or libjpeg-turbo. Inks of a CMYK JPEG are turned to red, green and blue
/// without a colour profile. Throws Error, placed by `where`, if the image is neither PNG nor JPEG, is damaged, has too
/// many scans, or would take more memory than `room` has.
DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where);

} // namespace gnomon::read
