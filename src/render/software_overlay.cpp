#include "render/software_overlay.h"

#include "render/frame_block.h"
#include "render/gl/geometry_pool.h"
#include "render/lod_substitutes.h"
#include "render/overlay/overlay_colors.h"

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

/// Returns the colour of a surface that uses no shadow map: diagonal stripes that are four pixels wide. `light` scales
/// the brightness.
glm::vec3 withoutMap(const PaintedPixel& pixel, float light) {
    return glm::vec3(light) * kWithoutMap[(pixel.x + pixel.y) / 4 % 2 == 0 ? 0 : 1];
}

glm::vec4 clipOf(const block::Partition& part, const glm::vec3& p) {
    return part.clipFromOffset * glm::vec4(p - part.origin, 1);
}

glm::vec2 texelAt(const block::Partition& part, const glm::vec4& clip) {
    const float up = part.logRows == 0 ? clip.y / clip.w : std::log(std::max(clip.w, 1e-30F));
    return glm::vec2(clip.x / clip.w, up) * part.texelScale + part.texelOffset;
}

} // namespace

SoftwareOverlay::SoftwareOverlay(
    const DrawInputs& frame,
    const block::Frame& block,
    const block::Shadows& shadows,
    std::span<const DrawnCluster> clusters)
    : frame_(&frame), block_(&block), shadows_(&shadows) {
    if (frame.overlay != Overlay::Lod && frame.overlay != Overlay::Clusters) return;
    for (const DrawnCluster& cluster : clusters) {
        std::vector<ClusterMark>& marks = marks_[cluster.pageId];
        if (!marks.empty()) continue;
        const std::vector<PackedVertex> packed = packedVertices(cluster.pageId, *cluster.page, frame.grid);
        for (const hierarchy::Cluster& stored : cluster.page->clusters) {
            const PackedVertex& vertex = packed[stored.firstVertex];
            const auto code = static_cast<float>(vertex.color >> 24U);
            const std::uint32_t tint =
                vertex.position.x >> 31U | vertex.position.y >> 31U << 1U | vertex.position.z >> 31U << 2U;
            marks.push_back({code == 0 ? 0 : block.gridStep * std::exp2((code - 9) / 8), static_cast<int>(tint)});
        }
    }
}

float SoftwareOverlay::aliasing(int pass, const glm::vec3& position, float depth) const {
    const block::Partition& part = shadows_->partitions[pass];
    const glm::vec4 clip = clipOf(part, position);
    const glm::vec4 dx = part.clipFromOffset * glm::vec4(part.axisX, 0);
    const glm::vec4 dz = part.clipFromOffset * glm::vec4(part.axisZ, 0);
    glm::vec2 perX = glm::abs(glm::vec2(dx) * clip.w - glm::vec2(clip) * dx.w) * part.texelScale;
    glm::vec2 perZ = glm::abs(glm::vec2(dz) * clip.w - glm::vec2(clip) * dz.w) * part.texelScale;
    if (part.logRows != 0) { // with logarithmic rows, the row changes in proportion to dw / w
        perX.y = std::abs(dx.w) * clip.w * part.texelScale.y;
        perZ.y = std::abs(dz.w) * clip.w * part.texelScale.y;
    }
    const float texels = std::min(std::max(perX.x, perX.y), perX.y > perX.x ? perZ.x : perZ.y) / (clip.w * clip.w);
    return 1 / (std::max(texels, 1e-30F) * block_->pixelSlope * depth);
}

glm::vec3 SoftwareOverlay::residence(const DrawnCluster& cluster) const {
    const Residence why = residenceOf(frame_->substitutes, cluster.pageId, cluster.cluster);
    return kResidenceColors[static_cast<std::size_t>(why)];
}

float SoftwareOverlay::texelGrid(const PaintedPixel& pixel) const {
    const block::Partition& part = shadows_->partitions[pixel.pass];
    const auto at = [&](int column, int row) {
        // Intersects the primary ray of pixel (column, row) with the plane of the triangle.
        const glm::dvec3 origin =
            pixel.rayOrigin + double(column - pixel.x) * pixel.originPerX + double(row - pixel.y) * pixel.originPerY;
        const glm::dvec3 fromOrigin = glm::dvec3(pixel.position) - origin;
        const double distance = glm::dot(glm::dvec3(pixel.normal), fromOrigin);
        const glm::dvec3 ray = glm::dvec3(pixel.ray) + double(column - pixel.x) * glm::dvec3(pixel.rayPerX) +
                               double(row - pixel.y) * glm::dvec3(pixel.rayPerY);
        const double across = glm::dot(glm::dvec3(pixel.normal), ray);
        const glm::dvec3 hit = across == 0 ? fromOrigin : ray * (distance / across);
        return (texelAt(part, clipOf(part, glm::vec3(hit + origin))) - part.firstTexel) / 5.0F;
    };
    // Differences between pixels are computed within blocks of two by two pixels, as in OpenGL.
    const int left = pixel.x & ~1;
    const int low = pixel.y & ~1;
    const glm::vec2 perX = glm::abs(at(left + 1, pixel.y) - at(left, pixel.y));
    const glm::vec2 perY = glm::abs(at(pixel.x, low + 1) - at(pixel.x, low));
    const glm::vec2 wide = glm::max(perX + perY, glm::vec2(1e-6F));
    const glm::vec2 fromLine = glm::abs(glm::fract(at(pixel.x, pixel.y) - 0.5F) - 0.5F);
    const glm::vec2 line = 1.0F - glm::smoothstep(glm::vec2(0.5F), glm::vec2(1.5F), fromLine / wide);
    const glm::vec2 density = glm::clamp(1.5F - 3.0F * wide, 0.0F, 1.0F);
    return std::max(line.x * density.x, line.y * density.y);
}

glm::vec3 SoftwareOverlay::painted(const PaintedPixel& pixel) const {
    const glm::vec3& shaded = pixel.shaded;
    const float light = glm::dot(shaded, glm::vec3(0.3F, 0.5F, 0.2F));
    const block::Partition* part = pixel.pass < 0 ? nullptr : &shadows_->partitions[pixel.pass];
    switch (frame_->overlay) {
    case Overlay::Partitions:
        return part == nullptr ? withoutMap(pixel, light) : indexColor(pixel.pass) * (0.7F + 0.3F * light);
    case Overlay::Texels:
        if (part == nullptr) return shaded * 0.8F;
        return glm::mix(
            glm::mix(shaded, indexColor(pixel.pass) * (0.3F + light), 0.25F),
            glm::vec3(0, 0.05F, 0.1F),
            0.85F * texelGrid(pixel));
    case Overlay::Aliasing:
        if (part == nullptr) return withoutMap(pixel, light);
        return heatColor(aliasing(pixel.pass, pixel.position, pixel.depth)) * (0.8F + 0.2F * light);
    case Overlay::Lod:
        return heatColor(
                   mark(pixel).error / (block_->pixelSlope * pixel.depth) / std::max(block_->errorPixels, 1e-6F)) *
               (0.8F + 0.2F * light);
    case Overlay::Clusters:
        return indexColor(mark(pixel).tint) * (0.7F + 0.3F * light);
    case Overlay::Projection: {
        if (part == nullptr) return withoutMap(pixel, light);
        const glm::vec3 towardsEye = glm::normalize(block_->eye - pixel.position);
        const glm::vec3 towardsLight =
            block_->pointReach > 0 ? glm::normalize(block_->towardsLight - pixel.position) : block_->towardsLight;
        const float toLight = glm::dot(pixel.normal, towardsLight);
        const float projection = std::max(glm::dot(pixel.normal, towardsEye), 0.0F) / std::max(toLight, 1e-6F);
        return heatColor(projection) * (0.8F + 0.2F * light);
    }
    case Overlay::Residency:
        return residence(*pixel.cluster) * (0.7F + 0.3F * light);
    case Overlay::None:
        break;
    }
    return shaded;
}

} // namespace gnomon::render
