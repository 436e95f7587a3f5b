#include "frame/picture_memory.h"

#include "exact/exact_shadows.h"
#include "executor/light/light_sum.h"
#include "executor/picture.h"
#include "plan/shadow_decision.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

// bytes per pixel: colour and coverage
constexpr std::uint64_t kFinished = sizeof(executor::Rgb) + sizeof(std::uint8_t);

/// Returns the kind of shadows that the software backend draws.
plan::ShadowMode shadowsOf(const plan::Quality& quality) {
    return plan::decideShadows(quality, plan::kSoftwareCapabilities).mode;
}

/// Returns the bytes per pixel while an image is drawn.
std::uint64_t bytesPerPixel(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    constexpr std::uint64_t kAwaited = 3 * sizeof(std::uint32_t) + sizeof(float) + sizeof(std::uint8_t);
    constexpr std::uint64_t kMapOfLamp = sizeof(std::int32_t);
    std::uint64_t bytes = sizeof(std::uint64_t) + 2 * sizeof(executor::Rgb); // visibility buffer, image and its copy
    if (options.wantsSurfaces) bytes += sizeof(executor::SurfaceSample);
    if (options.isAccumulated)
        bytes += executor::LightSum::bytes(1, quality.look.ground, quality.sky.directions > 0).count;
    const bool hasSun = !plan::isWithoutSun(quality.look.shading);
    const plan::ShadowMode shadows = shadowsOf(quality);
    if (hasSun && shadows != plan::ShadowMode::Off && shadows != plan::ShadowMode::Maps)
        bytes += exact::ExactShadows::kBytesPerSample + (view.pointLight ? kMapOfLamp : 0);
    else if (hasSun && shadows == plan::ShadowMode::Maps && !options.isAccumulated)
        bytes += kAwaited;
    return bytes;
}

/// Returns the memory that does not depend on the image size: the depth texture, or the cells of exact shadows.
std::uint64_t fixedBytes(const plan::Quality& quality) {
    constexpr std::uint64_t kCells = mebibytes(8).count;
    const auto texels =
        static_cast<std::uint64_t>(quality.shadowTexelsWidth) * static_cast<std::uint64_t>(quality.shadowTexelsHeight);
    const plan::ShadowMode shadows = shadowsOf(quality);
    if (shadows == plan::ShadowMode::Maps) return texels * sizeof(float);
    return shadows == plan::ShadowMode::Exact ? kCells : 0;
}

/// Returns true if the image can be drawn in bands of rows, because the caller does not need all rows at once.
bool canHaveBands(const plan::View& view, const FrameOptions& options) {
    return options.overlay == executor::Overlay::None && !options.wantsSurfaces && !options.wantsWholeImage &&
           !options.wantsWholeMaps && !options.observerCamera && view.sections.empty();
}

} // namespace

Bytes pictureBytes(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    const auto width = static_cast<std::uint64_t>(view.width);
    const auto height = static_cast<std::uint64_t>(view.height);
    const auto rows = options.rows ? static_cast<std::uint64_t>(options.rows->count) : height;
    return {width * rows * bytesPerPixel(view, quality, options) + width * height * kFinished + fixedBytes(quality)};
}

std::vector<executor::ImageRows> bandsOf(
    const plan::View& view, const plan::Quality& quality, const FrameOptions& options, Bytes memory) {
    constexpr int kMinRows = 64; // a multiple of the block heights of shading and of masks
    const bool fits = pictureBytes(view, quality, options).count <= memory.count / 2;
    if (fits || !canHaveBands(view, options)) return {{0, view.height}};
    const std::uint64_t perStripe =
        bytesPerPixel(view, quality, options) * static_cast<std::uint64_t>(view.width) * kMinRows;
    const std::uint64_t stripes = std::max<std::uint64_t>(memory.count / 4 / perStripe, 1);
    const int rows =
        static_cast<int>(std::min<std::uint64_t>(stripes * kMinRows, static_cast<std::uint64_t>(view.height)));
    std::vector<executor::ImageRows> bands;
    for (int first = 0; first < view.height; first += rows)
        bands.push_back({first, std::min(rows, view.height - first)});
    return bands;
}

} // namespace gnomon::frame
