// Paints overlays on the CPU, with the same operations and names as in shaders/image/overlay.glsl.
#pragma once

#include "render/software_pass.h"
#include "shaders/shared/frame_block.h"

#include <unordered_map>

namespace gnomon::render {

/// A shaded pixel on which an overlay is painted, with its surface and its primary ray.
struct PaintedPixel {
    glm::vec3 shaded{0};
    glm::vec3 position{0}; // camera-relative space
    float depth = 0;       // view depth
    int pass = -1;         // index of the shadow map of the lookup; -1: none
    // Start of the primary ray through the pixel's centre. originPerX and originPerY are the changes per pixel.
    glm::dvec3 rayOrigin{0};
    glm::dvec3 originPerX{0};
    glm::dvec3 originPerY{0};
    glm::vec3 ray{0}; // direction of this ray, and its change per pixel
    glm::vec3 rayPerX{0};
    glm::vec3 rayPerY{0};
    glm::vec3 normal{0}; // normal of the triangle
    int x = 0;
    int y = 0; // row, counted from the bottom
    const DrawnCluster* cluster = nullptr;
};

/// Paints the overlay of one frame. Several threads can use the same object.
class SoftwareOverlay {
public:
    /// Prepares the overlay of `frame`. The blocks and `frame` must outlive this object. `clusters` are the drawn
    /// clusters of the image.
    SoftwareOverlay(
        const DrawInputs& frame,
        const block::Frame& block,
        const block::Shadows& shadows,
        std::span<const DrawnCluster> clusters);

    glm::vec3 painted(const PaintedPixel& pixel) const;

private:
    float aliasing(int pass, const glm::vec3& position, float depth) const;
    glm::vec3 residence(const DrawnCluster& cluster) const;
    float texelGrid(const PaintedPixel& pixel) const;

    /// The error (in world units) and the colour index of a cluster, with the same precision as in the shaders.
    struct ClusterMark {
        float error = 0;
        int tint = 0;
    };

    ClusterMark mark(const PaintedPixel& pixel) const {
        return marks_.at(pixel.cluster->pageId)[pixel.cluster->cluster];
    }

    const DrawInputs* frame_;
    const block::Frame* block_;
    const block::Shadows* shadows_;
    // Error and colour index of each cluster, per page. The table is empty if the overlay does not show clusters.
    std::unordered_map<std::uint32_t, std::vector<ClusterMark>> marks_;
};

} // namespace gnomon::render
