// The images that textures are baked from: PNG and JPEG, known by their first bytes.
#include "core/error.h"
#include "harness.h"
#include "preprocess/read/gltf/decoded_image.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    read::MemoryRoom room("image", mebibytes(64));
    try {
        const read::DecodedImage image = read::decodedImage(std::as_bytes(std::span(data, size)), room, "image");
        const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        if (image.pixels.size() != pixels * 4) std::abort();
    } catch (const Error&) { // refused in words
    }
    return 0;
}
