// Shades the visibility buffer on the CPU: collects batches of visible pixels, calls the SIMD shading kernel, and
// writes the colours.
#pragma once

#include "exact/lookup_mask.h"
#include "exact/sample_list.h"
#include "exact/visible_points.h"
#include "render/shading_kernel.h"
#include "render/software_overlay.h"

#include <atomic>

namespace gnomon::render {

/// Converts a colour that is packed into 32 bits (red in the low byte) to three bytes.
constexpr Rgb unpacked(std::uint32_t color) {
    return {
        static_cast<std::uint8_t>(color),
        static_cast<std::uint8_t>(color >> 8U),
        static_cast<std::uint8_t>(color >> 16U)};
}

/// Output for exact shadows: the visible points whose shadow is computed before their pixels are shaded.
struct UnresolvedPixels {
    exact::SampleList* samples = nullptr; // receives the visible points that face the light
    std::uint32_t tolerance = 0;          // tolerance of the samples, as in exact::intersect
    std::vector<float> sliceEnds;         // view depths of the far ends of the sample grids' slices, nearest first
    exact::VisiblePoints* points =
        nullptr; // if not null, receives all pixels instead of `samples`, also those that face away from the light
};

/// Output for pixels whose shadow maps are drawn later. `mask` receives their shadow map lookups. With `isLitLater`,
/// the pixels are also listed, in any order. An entry has the pixel, its texel of the depth texture, the depth for the
/// comparison, the lit colour in the format of PixelBatch, and whether the pixel counts as lit when light reaches it.
struct AwaitedPixels {
    exact::LookupMask* mask = nullptr;
    bool isLitLater = false;
    // One entry per listed pixel. The arrays have memory for all pixels, but only the first `size` entries are valid.
    std::vector<std::uint32_t> pixels, texels, litColors;
    std::vector<float> depths;
    std::vector<std::uint8_t> counts;
    std::atomic<std::size_t> size{0};
};

/// The output buffers of shading, with rows from top to bottom. `surfaces` can be null.
struct ShadingTarget {
    Picture* picture = nullptr;
    Raster<SurfaceSample>* surfaces = nullptr;
    // If not null, shading only collects the visible points here. All other outputs stay unchanged.
    UnresolvedPixels* unresolved = nullptr;
    // If not null, pixels are shaded as in shadow, and shadow map lookups for later are collected here. A pixel that
    // needs no lookup receives its final colour immediately.
    AwaitedPixels* awaited = nullptr;
    // Receives the number of pixels that are known to be at least partly lit.
    std::atomic<std::uint64_t>* litPixels = nullptr;
    LightPicture* light = nullptr;           // with `wantsLight`: receives the light of `picture`
    const shadow::TileMask* tiles = nullptr; // the tiles to shade; null: all pixels
};

/// Tells when shadows are computed. Known: before shading. Unresolved: after the visible points are collected, as exact
/// shadows. Awaited: after shading, by shadow maps that are drawn later.
enum class Verdict : std::uint8_t { Known, Unresolved, Awaited };

/// Shades one frame on the CPU. Several threads can shade different boxes of the image in parallel.
class Shading {
public:
    /// Prepares the shading of `frame`. All arguments must outlive this object. `shadowDepth` is the depth texture of
    /// the shadow maps, or empty without maps. `clusters` are the drawn clusters of the image, to which triangle ids
    /// refer. If `verdict` is Unresolved or Awaited, each ShadingTarget must have a non-null `unresolved` or `awaited`.
    Shading(
        const DrawInputs& frame,
        const glm::dmat4& clipFromDraw,
        const FloatPicture& shadowDepth,
        std::span<const DrawnCluster> clusters,
        Verdict verdict = Verdict::Known);

    Shading(const Shading&) = delete;
    Shading& operator=(const Shading&) = delete;
    Shading(Shading&&) = delete;
    Shading& operator=(Shading&&) = delete;
    ~Shading() = default;

    /// Shades each pixel of `box`, whose rows are counted from the bottom of the image. `words` is the visibility
    /// buffer, with the same rows as the target.
    void shade(const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target) const;

    /// Returns the rows of the image that each target contains.
    ImageRows rows() const { return rows_; }

    /// Returns the constants of the frame for the SIMD shading kernel.
    const ShadingFrame& frame() const { return shared_; }

private:
    struct Work;

    void shadeSquare(
        const raster::PixelBox& box,
        std::span<const std::uint64_t> words,
        const ShadingTarget& target,
        Work& work) const;
    void gatherTriangles(Work& work) const;
    void flush(Work& work, const ShadingTarget& target) const;
    void leaveUnresolved(Work& work, const ShadingTarget& target) const;
    void leaveAwaited(Work& work, const ShadingTarget& target) const;
    Rgb painted(const Work& work, std::size_t i) const;
    void keepLight(const Work& work, const ShadingTarget& target) const;
    void colorGround(Work& work) const;
    void leaveUnshaded(std::size_t at, bool isCap, const ShadingTarget& target) const;
    std::array<float, 3> lightOfCap(const Rgb& color) const;
    std::array<float, 3> lightOfGround(float lit) const;

    /// Returns the row of a target, counted from the top, that contains row `row` of the image, counted from the
    /// bottom.
    int fromTop(int row) const { return rows_.first + rows_.count - 1 - row; }

    bool isGround(const Work& work, std::size_t i) const;

    bool countsAsLit(const Work& work, std::size_t i) const;
    void countLit(const Work& work, const ShadingTarget& target) const;

    const DrawInputs* frame_;
    ImageRows rows_;
    std::span<const DrawnCluster> clusters_;
    block::Frame block_;
    block::Shadows shadows_;
    ShadingFrame shared_;
    glm::dvec3 rayOrigin_{0}; // start of the ray through the image point (0, 0); camera-relative space
    glm::dvec3 originPerX_{0};
    glm::dvec3 originPerY_{0};
    SoftwareOverlay overlay_;
    std::vector<Rgb> background_; // colour per row, from the top
    std::vector<Rgb> shadowed_;   // background in a ground shadow, per row
    glm::vec3 leftInShadow_{1};
};

} // namespace gnomon::render
