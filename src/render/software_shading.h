// What the image's shaders compute, for the visible pixels on the CPU: the same operations in the same names.
#pragma once

#include "render/executor.h"
#include "shaders/shared/frame_block.h"

#include <span>
#include <unordered_map>

namespace gnomon::render {

/// A triangle's name in the visibility buffer: the drawn cluster's place above, the triangle's place in it below.
constexpr unsigned kTriangleBits = 8;

/// Where nothing is.
constexpr Rgb kBackground = {219, 227, 237};

/// A cluster of the image's draw list.
struct VisibleCluster {
    const hierarchy::Page* page = nullptr;
    std::uint32_t pageId = 0;
    std::uint32_t cluster = 0; // in the page
};

/// The image of one frame, ready to be asked row by row from any thread.
class Shading {
public:
    /// All arguments must outlive it; `shadowDepth` is empty without maps.
    Shading(
        const FrameDrawing& frame,
        const glm::dmat4& clipFromDraw,
        const FloatPicture& shadowDepth,
        std::span<const VisibleCluster> clusters);

    /// Row `y` from the bottom, from its words of the visibility buffer; pixels where nothing is stay as they are.
    /// `surfaces` may be null.
    void shadeRow(int y, std::span<const std::uint64_t> words, Rgb* colors, SurfaceSample* surfaces) const;

private:
    struct Corners;
    struct Surface;

    struct ShadedPixel {
        Rgb color{};
        SurfaceSample surface;
    };

    Corners corners(std::uint32_t triangle) const;
    ShadedPixel shade(const Corners& at, int x, int y) const;
    glm::dvec3 weights(const Corners& corners, double x, double y) const;
    Surface surface(const Corners& corners, int x, int y) const;
    static glm::vec3 position(const Corners& corners, const glm::dvec3& weights);

    int sliceOf(float z) const;
    int faceOf(const glm::vec3& p, int slice) const;
    int partitionOf(const glm::vec3& p, float z) const;
    float receiverBias(const block::Partition& part, const glm::vec4& plane, float cosine) const;
    float litFraction(int index, const glm::vec3& p, const glm::vec3& normal, float cosine) const;

    glm::vec3 overlaid(const glm::vec3& shaded, const Corners& corners, const Surface& surface, int index) const;
    float aliasing(const block::Partition& part, const glm::vec3& position, float depth) const;
    float texelGrid(const block::Partition& part, const Corners& corners, int x, int y) const;

    const FrameDrawing* frame_;
    const FloatPicture* shadowDepth_;
    std::span<const VisibleCluster> clusters_;
    glm::dmat4 clipFromDraw_;
    block::Frame block_;
    block::Shadows shadows_;
    bool hasMaps_ = false;

    /// Overlays of clusters alone need it: by page, each cluster's error and colour as the shaders are told them.
    struct ClusterMark {
        float error = 0;
        int tint = 0;
    };

    std::unordered_map<std::uint32_t, std::vector<ClusterMark>> marks_;
};

} // namespace gnomon::render
