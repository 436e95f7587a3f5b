#include "render/light/eye_dome.h"

#include "core/check.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::render {

namespace {

constexpr float kStrength = 24;
constexpr float kDarkest = 0.3F;
/// Pixel offsets to four neighbours. The opposite neighbours have the negated offsets. With these offsets, outlines are
/// two pixels wide.
constexpr std::array<std::array<int, 2>, 4> kAround = {{{2, 0}, {0, 2}, {1, 1}, {1, -1}}};

void darken(Rgb& pixel, float light) {
    for (std::uint8_t& channel : pixel)
        channel = static_cast<std::uint8_t>(std::lround(light * static_cast<float>(channel)));
}

} // namespace

void applyEyeDome(Picture& picture, const FloatPicture& depth, double parallelDistance) {
    GNOMON_CHECK(picture.width == depth.width && picture.height == depth.height);
    const int width = picture.width;
    const int height = picture.height;
    // Nearness is a function of depth that is linear over a plane: 1/depth in perspective, or minus depth with
    // parallel rays. Without a surface, 1/depth is 0.
    const bool isParallel = parallelDistance > 0;
    const auto perDepth = static_cast<float>(isParallel ? -1 / parallelDistance : 0);
    const auto nearness = [&](int x, int y) {
        const float own = depth.at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
        return isParallel ? own * perDepth : 1 / own;
    };
    const auto lightAt = [&](int x, int y) {
        const float own = nearness(x, y);
        float occlusion = 0;
        for (const auto& [right, down] : kAround) {
            const float around = 0.5F * (nearness(x + right, y + down) + nearness(x - right, y - down));
            occlusion += std::clamp(isParallel ? around - own : around / own - 1, 0.0F, 1.0F);
        }
        return std::max(1 / (1 + kStrength / 4 * occlusion), kDarkest);
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const auto& rows) {
        for (int y = rows.begin(); y < rows.end(); ++y)
            for (int x = 0; x < width; ++x)
                if (std::isfinite(depth.at(x, y))) darken(picture.at(x, y), lightAt(x, y));
    });
}

} // namespace gnomon::render
