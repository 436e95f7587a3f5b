// From the visibility buffer to the image: what is seen at each pixel, gathered for the vector kernel, and its colours.
#pragma once

#include "exact/lookup_mask.h"
#include "exact/sample_list.h"
#include "exact/visible_points.h"
#include "executor/shading_kernel.h"
#include "executor/software_overlay.h"

#include <atomic>

namespace gnomon::executor {

/// The bytes of a PixelBatch's colour.
constexpr Rgb unpacked(std::uint32_t color) {
    return {
        static_cast<std::uint8_t>(color),
        static_cast<std::uint8_t>(color >> 8U),
        static_cast<std::uint8_t>(color >> 16U)};
}

/// Pixels whose verdict is still to come.
struct UndecidedPixels {
    exact::SampleList* samples = nullptr; // get those that face the light, by their pixels, and their colours in it
    std::uint32_t tolerance = 0;          // as exact::meet takes it
    std::vector<float> sliceEnds;         // view depths where the slices of cell maps end, nearest first
    exact::VisiblePoints* points =
        nullptr; // gets all of them in place of `samples`, whether they face the light or not
};

/// Pixels whose maps are still to be drawn: `mask` gets what will be looked up. Where `isLitLater` they are listed too,
/// one after another in any order: which pixel, which texel of the depth texture, the depth that is compared with it,
/// the colour in the light, as PixelBatch has it, and whether the pixel counts as lit once the light reaches it.
struct AwaitedPixels {
    exact::LookupMask* mask = nullptr;
    bool isLitLater = false;
    std::vector<std::uint32_t> pixels, texels, litColors; // with room for every pixel; the first `size` count
    std::vector<float> depths;
    std::vector<std::uint8_t> counts;
    std::atomic<std::size_t> size{0};
};

/// Rows of the image from top to bottom; `surfaces` may be null.
struct ShadingTarget {
    Picture* picture = nullptr;
    Raster<SurfaceSample>* surfaces = nullptr;
    UndecidedPixels* undecided = nullptr;            // shades each pixel in shadow, and leaves to this what is lit
    AwaitedPixels* awaited = nullptr;                // likewise; where no map is asked, pixels get their colour at once
    std::atomic<std::uint64_t>* litPixels = nullptr; // counts those that are known to be lit at least in part
    LightPicture* light = nullptr;                   // both with a frame's `wantsLight`: the light of `picture`,
    LightPicture* undecidedLight = nullptr;          // and of undecided pixels that in which they are lit
    const shadow::TileMask* tiles = nullptr;         // which pixels are shaded; null: all
};

/// What the verdict of a shading hangs on where neither the plan nor a mask tells.
enum class Verdict : std::uint8_t { Known, Undecided, Awaited };

/// The image of one frame, ready to be shaded box by box from any thread.
class Shading {
public:
    /// All arguments must outlive it; `shadowDepth` is empty without maps, `clusters` are those of the image's pass;
    /// `verdict` calls for targets with `undecided` or
    /// `awaited`.
    Shading(
        const FrameDrawing& frame,
        const glm::dmat4& clipFromDraw,
        const FloatPicture& shadowDepth,
        std::span<const DrawnCluster> clusters,
        Verdict verdict = Verdict::Known);

    Shading(const Shading&) = delete;
    Shading& operator=(const Shading&) = delete;
    Shading(Shading&&) = delete;
    Shading& operator=(Shading&&) = delete;
    ~Shading() = default;

    /// Writes every pixel of `box` (rows from the bottom of the image) from the words of the visibility buffer, which
    /// holds the same rows as the target.
    void shade(const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target) const;

    /// The rows that targets hold.
    ImageRows rows() const { return rows_; }

    /// What the kernel is told of the frame.
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
    void leaveUndecided(Work& work, const ShadingTarget& target) const;
    void leaveAwaited(Work& work, const ShadingTarget& target) const;
    Rgb painted(const Work& work, std::size_t i) const;
    void keepLight(const Work& work, const ShadingTarget& target) const;
    void colorGround(Work& work) const;
    void leaveUnshaded(std::size_t at, bool isCap, const ShadingTarget& target) const;
    std::array<float, 3> lightOfCap(const Rgb& color) const;
    std::array<float, 3> lightOfGround(float lit) const;

    /// The row of a target that holds row `row` of the image.
    int fromTop(int row) const { return rows_.first + rows_.count - 1 - row; }

    bool isGround(const Work& work, std::size_t i) const;

    bool countsAsLit(const Work& work, std::size_t i) const;
    void countLit(const Work& work, const ShadingTarget& target) const;

    const FrameDrawing* frame_;
    ImageRows rows_;
    std::span<const DrawnCluster> clusters_;
    block::Frame block_;
    block::Shadows shadows_;
    ShadingFrame shared_;
    glm::dvec3 rayOrigin_{0}; // draw space; of the image point (0, 0)
    glm::dvec3 originPerX_{0};
    glm::dvec3 originPerY_{0};
    SoftwareOverlay overlay_;
    std::vector<Rgb> background_; // by row, from the top
    std::vector<Rgb> shadowed_;   // the same where a shadow lies on the ground
    glm::vec3 leftInShadow_{1};
};

} // namespace gnomon::executor
