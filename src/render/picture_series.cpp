#include "render/picture_series.h"

#include "core/formatted.h"

#include <cmath>

namespace gnomon::render {

std::optional<std::string> numberedName(const std::string& pattern, int number) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string::npos || pattern.find('%', percent + 1) != std::string::npos) return std::nullopt;
    std::size_t end = percent + 1;
    int width = 0;
    if (end + 1 < pattern.size() && pattern[end] == '0' && pattern[end + 1] >= '1' && pattern[end + 1] <= '9') {
        width = pattern[end + 1] - '0';
        end += 2;
    }
    if (end >= pattern.size() || pattern[end] != 'd') return std::nullopt;
    return pattern.substr(0, percent) + formatted("%0*d", width, number) + pattern.substr(end + 1);
}

std::string y4mHeader(int width, int height, double framesPerSecond) {
    constexpr int kParts = 1000;
    return formatted(
        "YUV4MPEG2 W%d H%d F%ld:%d Ip A1:1 C444 XCOLORRANGE=LIMITED\n",
        width,
        height,
        std::lround(framesPerSecond * kParts),
        kParts);
}

std::string y4mFrame(const Picture& picture) {
    const std::size_t count = picture.pixels.size();
    std::string frame = "FRAME\n";
    const std::size_t luma = frame.size();
    frame.resize(luma + 3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [r, g, b] = picture.pixels[i];
        // The coefficients are the BT.709 matrix in units of 1/65536, times 219/255 for luma and 224/255 for chroma,
        // rounded. The coefficients of each chroma row add up to 0.
        frame[luma + i] = static_cast<char>(16 + (11966 * r + 40254 * g + 4064 * b + 32768) / 65536);
        frame[luma + count + i] = static_cast<char>((-6596 * r - 22189 * g + 28785 * b + 128 * 65536 + 32768) / 65536);
        frame[luma + 2 * count + i] =
            static_cast<char>((28785 * r - 26145 * g - 2640 * b + 128 * 65536 + 32768) / 65536);
    }
    return frame;
}

} // namespace gnomon::render
