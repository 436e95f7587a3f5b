// From the visibility buffer to the image: collects the visible triangles for the vector kernel, and writes their
// colours.
#pragma once

#include "exact/lookup_mask.h"
#include "exact/sample_list.h"
#include "exact/visible_points.h"
#include "render/shading_kernel.h"
#include "render/software_overlay.h"

#include <atomic>

namespace gnomon::render {

/// Unpacks a colour of a PixelBatch to bytes.
constexpr Rgb unpacked(std::uint32_t color) {
    return {
        static_cast<std::uint8_t>(color),
        static_cast<std::uint8_t>(color >> 8U),
        static_cast<std::uint8_t>(color >> 16U)};
}

/// Pixels whose shadow is computed before they are shaded.
struct UnresolvedPixels {
    exact::SampleList* samples = nullptr; // receives the pixels that face the light
    std::uint32_t tolerance = 0;          // as in exact::intersect
    std::vector<float> sliceEnds;         // view depths of the ends of the slices of the sample grids, nearest first
    exact::VisiblePoints* points =
        nullptr; // if not null, receives all pixels instead of `samples`, also those that face away from the light
};

/// Pixels whose maps are drawn later. `mask` receives the later lookups. With `isLitLater`, the pixels are also listed
/// in any order. Each entry has the pixel, its texel of the depth texture, the depth for the comparison, the lit colour
/// in the format of PixelBatch, and whether the pixel counts as lit when light reaches it.
struct AwaitedPixels {
    exact::LookupMask* mask = nullptr;
    bool isLitLater = false;
    // The arrays have room for all pixels. Only the first `size` entries are valid.
    std::vector<std::uint32_t> pixels, texels, litColors;
    std::vector<float> depths;
    std::vector<std::uint8_t> counts;
    std::atomic<std::size_t> size{0};
};

/// The output of shading, with rows from top to bottom. `surfaces` can be null.
struct ShadingTarget {
    Picture* picture = nullptr;
    Raster<SurfaceSample>* surfaces = nullptr;
    // If not null, the visible points are only collected here. All other results are then unchanged.
    UnresolvedPixels* unresolved = nullptr;
    // If not null, pixels are shaded in shadow, and those whose maps are drawn later are collected here. A pixel that
    // needs no map gets its final colour immediately.
    AwaitedPixels* awaited = nullptr;
    std::atomic<std::uint64_t>* litPixels = nullptr; // counts the pixels that are known to be at least partly lit
    LightPicture* light = nullptr;                   // with `wantsLight`: the light of `picture`
    const shadow::TileMask* tiles = nullptr;         // the tiles to shade; null: all pixels
};

/// The state of the shadow result during shading, apart from the plan and the mask: known, unresolved until exact
/// shadows are computed, or awaited until the maps are drawn.
enum class Verdict : std::uint8_t { Known, Unresolved, Awaited };

/// The shading of one frame. All threads can shade boxes.
class Shading {
public:
    /// Prepares the shading. All arguments must outlive it. `shadowDepth` is empty without maps, and `clusters` are the
    /// clusters of the image's pass. A `verdict` other than Known requires targets with `unresolved` or `awaited`.
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

    /// Shades each pixel of `box` from the words of the visibility buffer. Rows of `box` count from the bottom of the
    /// image. The visibility buffer contains the same rows as the target.
    void shade(const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target) const;

    /// Returns the rows of the targets.
    ImageRows rows() const { return rows_; }

    /// Returns the constants of the frame for the kernel.
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

    /// Returns the row of a target that contains row `row` of the image.
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
    glm::dvec3 rayOrigin_{0}; // camera-relative space; for the image point (0, 0)
    glm::dvec3 originPerX_{0};
    glm::dvec3 originPerY_{0};
    SoftwareOverlay overlay_;
    std::vector<Rgb> background_; // per row, from the top
    std::vector<Rgb> shadowed_;   // the background in a ground shadow
    glm::vec3 leftInShadow_{1};
};

} // namespace gnomon::render
