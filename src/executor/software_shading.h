// From the visibility buffer to the image: what is seen at each pixel, gathered for the vector kernel, and its colours.
#pragma once

#include "exact/sample_list.h"
#include "executor/shading_kernel.h"
#include "executor/software_overlay.h"

namespace gnomon::executor {

/// Where nothing is.
constexpr Rgb kBackground = {219, 227, 237};

/// Pixels whose verdict is still to come.
struct UndecidedPixels {
    exact::SampleList* samples = nullptr; // get those that face the light, by their pixels, and their colours in it
    std::uint32_t tolerance = 0;          // as exact::meet takes it
    std::vector<float> sliceEnds;         // view depths where the slices of cell maps end, nearest first
};

/// Rows of the image from top to bottom; `surfaces` may be null.
struct ShadingTarget {
    Picture* picture = nullptr;
    Raster<SurfaceSample>* surfaces = nullptr;
    UndecidedPixels* undecided = nullptr; // shades each pixel in shadow, and leaves to this what is lit
};

/// The image of one frame, ready to be shaded box by box from any thread.
class Shading {
public:
    /// All arguments must outlive it; `shadowDepth` is empty without maps, `clusters` are those of the image's pass;
    /// `isUndecided` calls for targets with `undecided`.
    Shading(
        const FrameDrawing& frame,
        const glm::dmat4& clipFromDraw,
        const FloatPicture& shadowDepth,
        std::span<const DrawnCluster> clusters,
        bool isUndecided = false);

    Shading(const Shading&) = delete;
    Shading& operator=(const Shading&) = delete;
    Shading(Shading&&) = delete;
    Shading& operator=(Shading&&) = delete;
    ~Shading() = default;

    /// Writes every pixel of `box` (rows from the bottom) from the words of the visibility buffer of the whole image.
    void shade(const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target) const;

    /// What the kernel is told of the frame.
    const ShadingFrame& frame() const { return shared_; }

private:
    struct Work;

    void gatherTriangles(Work& work) const;
    void flush(Work& work, const ShadingTarget& target) const;
    void leaveUndecided(Work& work, const ShadingTarget& target) const;
    Rgb painted(const Work& work, std::size_t i) const;

    const FrameDrawing* frame_;
    std::span<const DrawnCluster> clusters_;
    block::Frame block_;
    block::Shadows shadows_;
    ShadingFrame shared_;
    glm::dvec3 rayOrigin_{0}; // draw space
    SoftwareOverlay overlay_;
};

} // namespace gnomon::executor
