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

/// The image in `encoded`, by libpng or libjpeg-turbo. Throws Error, placed by `where`, for one that is neither PNG nor
/// JPEG or is damaged, and before it is unpacked where `room` has none for it.
DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where);

} // namespace gnomon::read
