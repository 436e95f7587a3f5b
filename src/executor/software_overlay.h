// What shaders/image/overlay.glsl paints over the image, pixel by pixel on the CPU: the same operations in the same
// names.
#pragma once

#include "executor/software_pass.h"
#include "shaders/shared/frame_block.h"

#include <unordered_map>

namespace gnomon::executor {

/// A shaded pixel that is painted over.
struct PaintedPixel {
    glm::vec3 shaded{0};
    glm::vec3 position{0};   // draw space
    float depth = 0;         // along the view
    int pass = -1;           // the map that shows it; -1: none
    glm::dvec3 rayOrigin{0}; // of the ray through the pixel's centre, and what it changes by from pixel to pixel
    glm::dvec3 originPerX{0};
    glm::dvec3 originPerY{0};
    glm::vec3 ray{0}; // its direction, likewise
    glm::vec3 rayPerX{0};
    glm::vec3 rayPerY{0};
    glm::vec3 normal{0}; // of the face
    int x = 0;
    int y = 0; // from the bottom
    const DrawnCluster* cluster = nullptr;
};

/// Paints one frame's overlay, from any thread.
class SoftwareOverlay {
public:
    /// The blocks and `frame` must outlive it; `clusters` are those of the image.
    SoftwareOverlay(
        const FrameDrawing& frame,
        const block::Frame& block,
        const block::Shadows& shadows,
        std::span<const DrawnCluster> clusters);

    glm::vec3 painted(const PaintedPixel& pixel) const;

private:
    float aliasing(int pass, const glm::vec3& position, float depth) const;
    glm::vec3 residence(const DrawnCluster& cluster) const;
    float texelGrid(const PaintedPixel& pixel) const;

    /// A cluster's error (world units) and colour as the shaders are told them.
    struct ClusterMark {
        float error = 0;
        int tint = 0;
    };

    ClusterMark mark(const PaintedPixel& pixel) const {
        return marks_.at(pixel.cluster->pageId)[pixel.cluster->cluster];
    }

    const FrameDrawing* frame_;
    const block::Frame* block_;
    const block::Shadows* shadows_;
    std::unordered_map<std::uint32_t, std::vector<ClusterMark>> marks_; // by page; overlays of clusters alone need it
};

} // namespace gnomon::executor
