#include "render/overlay/window_picture.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace gnomon::render {

void takePicture(const Picture& picture, WindowPicture& words) {
    words.width = picture.width;
    words.height = picture.height;
    words.pixels.resize(picture.pixels.size());
    constexpr std::size_t kPixels = std::size_t{1} << 16U;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture.pixels.size(), kPixels), [&](const auto& range) {
        const Rgb* from = picture.pixels.data();
        std::uint32_t* to = words.pixels.data();
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            to[i] = 0xFF000000U | std::uint32_t{from[i][0]} << 16U | std::uint32_t{from[i][1]} << 8U | from[i][2];
    });
}

} // namespace gnomon::render
