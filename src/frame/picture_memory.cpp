#include "frame/picture_memory.h"

#include "exact/exact_shadows.h"
#include "plan/shadow_decision.h"
#include "render/light/light_sum.h"
#include "render/picture.h"

#include <algorithm>

namespace gnomon::frame {

namespace {

// bytes per pixel of the finished image: colour and coverage
constexpr std::uint64_t kFinished = sizeof(render::Rgb) + sizeof(std::uint8_t);

/// The memory that an image needs while it is drawn, in bytes.
struct Demand {
    std::uint64_t perPixel = 0;
    // independent of the image size: the depth texture and its masks, or the cells of exact shadows
    std::uint64_t fixed = 0;
    Bytes all;
};

Demand demandOf(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    constexpr std::uint64_t kAwaited = 3 * sizeof(std::uint32_t) + sizeof(float) + sizeof(std::uint8_t);
    constexpr std::uint64_t kLitMask = sizeof(std::uint8_t);
    constexpr std::uint64_t kMapOfLamp = sizeof(std::int32_t);
    constexpr std::uint64_t kCells = mebibytes(8).count;
    Demand demand;
    // The bytes per pixel are for the visibility buffer, the image and a copy of the image.
    demand.perPixel = sizeof(std::uint64_t) + 2 * sizeof(render::Rgb);
    if (options.wantsSurfaces) demand.perPixel += sizeof(render::SurfaceSample);
    if (options.isAccumulated)
        demand.perPixel += render::LightSum::bytes(1, quality.look.ground, quality.sky.directions > 0).count;
    const bool hasSun = !plan::hasNoSun(quality.look.shading);
    const plan::ShadowMode shadows = plan::chooseShadows(quality, plan::kSoftwareCapabilities).mode;
    if (hasSun && shadows != plan::ShadowMode::Off && shadows != plan::ShadowMode::Maps)
        demand.perPixel += exact::ExactShadows::kBytesPerSample + kLitMask + (view.pointLight ? kMapOfLamp : 0);
    else if (hasSun && shadows == plan::ShadowMode::Maps && !options.isAccumulated)
        demand.perPixel += kAwaited;
    if (shadows == plan::ShadowMode::Maps)
        demand.fixed = static_cast<std::uint64_t>(quality.shadowTexelsWidth) *
                       static_cast<std::uint64_t>(quality.shadowTexelsHeight) * sizeof(float);
    else if (shadows == plan::ShadowMode::Exact)
        demand.fixed = kCells;
    const auto width = static_cast<std::uint64_t>(view.width);
    const auto height = static_cast<std::uint64_t>(view.height);
    const auto rows = options.rows ? static_cast<std::uint64_t>(options.rows->count) : height;
    demand.all = {width * rows * demand.perPixel + width * height * kFinished + demand.fixed};
    return demand;
}

/// Returns true if the image can be drawn in bands of rows, because the caller does not need all rows at once.
bool canHaveBands(const plan::View& view, const FrameOptions& options) {
    return options.overlay == render::Overlay::None && !options.wantsSurfaces && !options.wantsWholeImage &&
           !options.wantsWholeMaps && !options.observerCamera && view.sections.empty();
}

} // namespace

Bytes pictureBytes(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
    return demandOf(view, quality, options).all;
}

std::vector<render::ImageRows> bandsOf(
    const plan::View& view, const plan::Quality& quality, const FrameOptions& options, Bytes memory) {
    constexpr int kMinRows = 64; // multiple of the rows per shading task and of the rows per mask block
    std::vector<render::ImageRows> whole = {{0, view.height}};
    if (!canHaveBands(view, options)) return whole;
    const Demand demand = demandOf(view, quality, options);
    if (demand.all.count <= memory.count / 2) return whole;
    const std::uint64_t perStripe = demand.perPixel * static_cast<std::uint64_t>(view.width) * kMinRows;
    const std::uint64_t stripes = std::max<std::uint64_t>(memory.count / 4 / perStripe, 1);
    const int rows =
        static_cast<int>(std::min<std::uint64_t>(stripes * kMinRows, static_cast<std::uint64_t>(view.height)));
    std::vector<render::ImageRows> bands;
    for (int first = 0; first < view.height; first += rows)
        bands.push_back({first, std::min(rows, view.height - first)});
    return bands;
}

} // namespace gnomon::frame
