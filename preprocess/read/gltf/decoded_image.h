// Decodes PNG and JPEG images of glTF textures.
#pragma once

#include "preprocess/read/gltf/memory_room.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// A decoded image with 8 bits per channel (RGBA8). Red is the first byte of a pixel, and the top row is first.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// Decodes the PNG or JPEG image `encoded` with libpng or libjpeg-turbo. A CMYK JPEG is converted to RGB without a
/// colour profile. Throws Error, which names `where`, if the image is neither PNG nor JPEG, is damaged, has too many
/// scans, or exceeds the memory budget `room`.
DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where);

} // namespace gnomon::read
