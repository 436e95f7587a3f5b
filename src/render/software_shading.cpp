#include "render/software_shading.h"

#include "raster/raster.h"
#include "render/frame_block.h"
#include "render/geometry_pool.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::render {

namespace {

/// Two snorm16 on the octahedron (Meyer et al. 2010).
glm::vec3 octahedral(std::uint32_t bits) {
    const glm::vec2 e = glm::unpackSnorm2x16(bits);
    glm::vec3 n(e, 1 - std::abs(e.x) - std::abs(e.y));
    if (n.z < 0) {
        const glm::vec2 folded = 1.0F - glm::abs(glm::vec2(n.y, n.x));
        n.x = folded.x * (n.x < 0 ? -1.0F : 1.0F);
        n.y = folded.y * (n.y < 0 ? -1.0F : 1.0F);
    }
    return glm::normalize(n);
}

glm::vec3 rgb(std::uint32_t color) {
    return glm::vec3(color & 0xFFU, color >> 8U & 0xFFU, color >> 16U & 0xFFU) * (1 / 255.0F);
}

/// Colours that are far apart for neighbouring indices: the golden angle on the hue circle.
glm::vec3 indexColor(int index) {
    const float hue = glm::fract(static_cast<float>(index) * 0.61803399F + 0.07F) * 6.0F;
    const glm::vec3 wheel = glm::abs(glm::mod(hue + glm::vec3(0, 4, 2), 6.0F) - 3.0F) - 1.0F;
    return glm::clamp(wheel, 0.0F, 1.0F) * 0.75F + 0.25F;
}

/// Blue under 1/4, green at 1, red at 4 and white from 16.
glm::vec3 heat(float value) {
    const float x = glm::clamp(std::log2(std::max(value, 1e-6F)) * 0.25F + 0.5F, 0.0F, 1.5F);
    const glm::vec3 cold =
        glm::mix(glm::vec3(0.1F, 0.2F, 0.8F), glm::vec3(0.1F, 0.75F, 0.3F), glm::clamp(2 * x, 0.0F, 1.0F));
    const glm::vec3 warm = glm::mix(cold, glm::vec3(0.9F, 0.1F, 0.1F), glm::clamp(2 * x - 1, 0.0F, 1.0F));
    return glm::mix(warm, glm::vec3(1), glm::clamp(2 * x - 2, 0.0F, 1.0F));
}

/// The nearest of 255 levels.
std::uint8_t level(float channel) {
    return static_cast<std::uint8_t>((static_cast<int>(510 * std::clamp(channel, 0.0F, 1.0F)) + 1) / 2);
}

} // namespace

struct Shading::Corners {
    std::array<glm::vec3, 3> positions{};
    std::array<glm::vec3, 3> normals{}; // zero where the face's own is to be taken
    std::array<glm::vec3, 3> colors{};
    glm::vec3 flatNormal{0};       // towards either side; zero if the triangle has no area
    glm::dmat3 weightsFromClip{1}; // of (x, y, w) of a pixel
    const VisibleCluster* cluster = nullptr;
};

struct Shading::Surface {
    int x = 0;
    int y = 0;
    glm::vec3 position{0};
    glm::vec3 color{0};
    glm::vec3 flatNormal{0}; // towards the eye
    glm::vec3 smoothNormal{0};
    float depth = 0;
};

Shading::Shading(
    const FrameDrawing& frame,
    const glm::dmat4& clipFromDraw,
    const FloatPicture& shadowDepth,
    std::span<const VisibleCluster> clusters)
    : frame_(&frame),
      shadowDepth_(&shadowDepth),
      clusters_(clusters),
      clipFromDraw_(glm::mat4(clipFromDraw)),
      block_(frameBlock(frame, clipFromDraw)),
      shadows_(shadowsBlock(frame)),
      hasMaps_(!frame.plan->passes.empty() && frame.litMask == nullptr) {
    if (frame.overlay != Overlay::Lod && frame.overlay != Overlay::Clusters) return;
    for (const VisibleCluster& cluster : clusters) {
        std::vector<ClusterMark>& marks = marks_[cluster.pageId];
        if (!marks.empty()) continue;
        const std::vector<PackedVertex> packed = packedVertices(cluster.pageId, *cluster.page, frame.grid);
        for (const hierarchy::Cluster& stored : cluster.page->clusters) {
            const PackedVertex& vertex = packed[stored.firstVertex];
            const auto code = static_cast<float>(vertex.color >> 24U);
            const std::uint32_t tint =
                vertex.position.x >> 31U | vertex.position.y >> 31U << 1U | vertex.position.z >> 31U << 2U;
            marks.push_back({code == 0 ? 0 : block_.eye.w * std::exp2((code - 9) / 8), static_cast<int>(tint)});
        }
    }
}

Shading::Corners Shading::corners(std::uint32_t triangle) const {
    Corners corners;
    corners.cluster = &clusters_[triangle >> kTriangleBits];
    const hierarchy::Page& page = *corners.cluster->page;
    const hierarchy::Cluster& cluster = page.clusters[corners.cluster->cluster];
    const hierarchy::Triangle& indices =
        page.triangles[cluster.firstTriangle + (triangle & ((1U << kTriangleBits) - 1U))];
    glm::dmat3 clip(1);
    for (std::size_t k = 0; k < 3; ++k) {
        const hierarchy::Vertex& vertex = page.vertices[cluster.firstVertex + indices[k]];
        const glm::ivec3 cell =
            glm::ivec3(vertex.position.x, vertex.position.y, vertex.position.z) - glm::ivec3(block_.originCell);
        corners.colors[k] = rgb(vertex.color);
        if (vertex.normal != hierarchy::kNoNormal) corners.normals[k] = octahedral(vertex.normal);
        corners.positions[k] = glm::vec3(cell) * block_.eye.w;
        const glm::dvec4 p = clipFromDraw_ * glm::dvec4(corners.positions[k], 1);
        clip[static_cast<int>(k)] = {p.x, p.y, p.w};
    }
    const glm::vec3 across =
        glm::cross(corners.positions[1] - corners.positions[0], corners.positions[2] - corners.positions[0]);
    const float size = glm::length(across);
    if (size > 0) corners.flatNormal = across / size;
    // The adjugate: only the ratios of the weights count, and it has no quotient to blow up.
    corners.weightsFromClip = glm::transpose(
        glm::dmat3(glm::cross(clip[1], clip[2]), glm::cross(clip[2], clip[0]), glm::cross(clip[0], clip[1])));
    return corners;
}

glm::dvec3 Shading::weights(const Corners& corners, double x, double y) const {
    const glm::dvec3 pixel(
        2 * x / static_cast<double>(block_.image.x) - 1, 2 * y / static_cast<double>(block_.image.y) - 1, 1);
    const glm::dvec3 weights = corners.weightsFromClip * pixel;
    const double sum = weights.x + weights.y + weights.z;
    return sum == 0 ? glm::dvec3(1, 0, 0) : weights / sum;
}

glm::vec3 Shading::position(const Corners& corners, const glm::dvec3& w) {
    const std::array<glm::vec3, 3>& at = corners.positions;
    return {w.x * glm::dvec3(at[0]) + w.y * glm::dvec3(at[1]) + w.z * glm::dvec3(at[2])};
}

Shading::Surface Shading::surface(const Corners& corners, int x, int y) const {
    Surface s;
    s.x = x;
    s.y = y;
    const glm::dvec3 exact = weights(corners, x + 0.5, y + 0.5);
    const glm::vec3 w(exact);
    s.position = position(corners, exact);
    s.color = w.x * corners.colors[0] + w.y * corners.colors[1] + w.z * corners.colors[2];
    const glm::vec3 normal = w.x * corners.normals[0] + w.y * corners.normals[1] + w.z * corners.normals[2];
    const glm::vec3 towardsEye = glm::vec3(block_.eye) - s.position;
    s.flatNormal = corners.flatNormal == glm::vec3(0) ? glm::normalize(towardsEye) : corners.flatNormal;
    if (glm::dot(s.flatNormal, towardsEye) < 0) s.flatNormal = -s.flatNormal;
    s.smoothNormal = normal == glm::vec3(0) ? s.flatNormal : glm::normalize(normal);
    if (glm::dot(s.smoothNormal, s.flatNormal) < 0) s.smoothNormal = -s.smoothNormal;
    s.depth = glm::dot(glm::vec3(block_.view), s.position) + block_.view.w;
    return s;
}

int Shading::sliceOf(float z) const {
    int slice = 0;
    while (slice + 1 < block_.counts.x && z >= shadows_.splits[slice].y)
        ++slice;
    return slice;
}

int Shading::faceOf(const glm::vec3& p, int slice) const {
    const auto isOwner = [&](int face) {
        return glm::dot(glm::vec3(shadows_.faceFirst[face]), p) >= 0 &&
               glm::dot(glm::vec3(shadows_.faceSecond[face]), p) >= 0;
    };
    int face = 0;
    while (face + 1 < block_.counts.z && !isOwner(face))
        ++face;
    const glm::vec4& edge = shadows_.faceEdge[face];
    const bool inNear = block_.counts.w == 1 && glm::dot(glm::vec3(edge), p) < edge.w * shadows_.splits[slice].x;
    return inNear ? block_.counts.z : face;
}

int Shading::partitionOf(const glm::vec3& p, float z) const {
    const int slice = sliceOf(z);
    const int facesPerSlice = std::max(block_.counts.z, 1) + block_.counts.w;
    const int index = slice * facesPerSlice + (block_.counts.z == 0 ? 0 : faceOf(p, slice));
    return shadows_.passOfPartition[index / 4][index % 4];
}

float Shading::receiverBias(const block::Partition& part, const glm::vec4& plane, float cosine) const {
    const glm::vec4 inTexels = plane * part.drawFromTexel;
    const float reach = 0.5F + 0.5F * static_cast<float>(std::max(block_.counts.y, 1) - 1) + 1.0F / 256.0F;
    const float slope = (std::abs(inTexels.x) + std::abs(inTexels.y)) / std::max(std::abs(inTexels.z), 1e-30F) *
                        std::min(1.0F, cosine / 0.1F);
    return slope * reach + 6e-7F;
}

float Shading::litFraction(int index, const glm::vec3& p, const glm::vec3& normal, float cosine) const {
    if (index < 0) return 1;
    const block::Partition& part = shadows_.partitions[index];
    const glm::vec4 q = part.texelFromDraw * glm::vec4(p, 1);
    const glm::vec3 texel = glm::vec3(q) / q.w;
    const float depth = texel.z - receiverBias(part, glm::vec4(normal, -glm::dot(normal, p)), cosine);
    const int width = std::max(block_.counts.y, 1);
    const glm::ivec2 lowest(part.rectangle.x, part.rectangle.y);
    const glm::ivec2 highest = glm::ivec2(part.rectangle.z, part.rectangle.w) - 1;
    const glm::ivec2 first(glm::floor(glm::vec2(texel) - 0.5F * static_cast<float>(width - 1)));
    float lit = 0;
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::ivec2 at = glm::clamp(first + glm::ivec2(x, y), lowest, highest);
            lit += depth <= shadowDepth_->at(at.x, at.y) ? 1.0F : 0.0F;
        }
    return lit / static_cast<float>(width * width);
}

float Shading::aliasing(const block::Partition& part, const glm::vec3& position, float depth) const {
    const glm::vec4 q = part.texelFromDraw * glm::vec4(position, 1);
    const glm::vec4 dx = part.texelFromDraw * glm::vec4(glm::vec3(part.axisX), 0);
    const glm::vec4 dz = part.texelFromDraw * glm::vec4(glm::vec3(part.axisZ), 0);
    const float columns = std::abs(dx.x * q.w - q.x * dx.w) / (q.w * q.w);
    const float rows = std::abs(dz.y * q.w - q.y * dz.w) / (q.w * q.w);
    return 1 / (std::max(std::min(columns, rows), 1e-30F) * block_.image.w * depth);
}

float Shading::texelGrid(const block::Partition& part, const Corners& corners, int x, int y) const {
    const auto at = [&](int column, int row) {
        const glm::vec4 q =
            part.texelFromDraw * glm::vec4(position(corners, weights(corners, column + 0.5, row + 0.5)), 1);
        return (glm::vec2(q) / q.w - glm::vec2(part.rectangle)) / 5.0F;
    };
    // Differences within squares of two by two pixels, as GL takes them.
    const int left = x & ~1;
    const int low = y & ~1;
    const glm::vec2 wide =
        glm::max(glm::abs(at(left + 1, y) - at(left, y)) + glm::abs(at(x, low + 1) - at(x, low)), glm::vec2(1e-6F));
    const glm::vec2 line =
        1.0F - glm::smoothstep(glm::vec2(0.5F), glm::vec2(1.5F), glm::abs(glm::fract(at(x, y) - 0.5F) - 0.5F) / wide);
    const glm::vec2 density = glm::clamp(1.5F - 3.0F * wide, 0.0F, 1.0F);
    return std::max(line.x * density.x, line.y * density.y);
}

glm::vec3 Shading::overlaid(const glm::vec3& shaded, const Corners& corners, const Surface& surface, int index) const {
    const float light = glm::dot(shaded, glm::vec3(0.3F, 0.5F, 0.2F));
    const block::Partition* part = index < 0 ? nullptr : &shadows_.partitions[index];
    const auto mark = [&] { return marks_.at(corners.cluster->pageId)[corners.cluster->cluster]; };
    switch (frame_->overlay) {
    case Overlay::Partitions:
        return part == nullptr ? glm::vec3(light) * 0.6F : indexColor(index) * (0.35F + 0.65F * light);
    case Overlay::Texels:
        if (part == nullptr) return shaded * 0.8F;
        return glm::mix(
            glm::mix(shaded, indexColor(index) * (0.3F + light), 0.25F),
            glm::vec3(0, 0.05F, 0.1F),
            0.85F * texelGrid(*part, corners, surface.x, surface.y));
    case Overlay::Aliasing:
        if (part == nullptr) return glm::vec3(light) * 0.5F;
        return heat(aliasing(*part, surface.position, surface.depth)) * (0.5F + 0.5F * light);
    case Overlay::Lod:
        return heat(mark().error / (block_.image.w * surface.depth) / std::max(block_.near.z, 1e-6F)) *
               (0.4F + 0.6F * light);
    case Overlay::Clusters:
        return indexColor(mark().tint) * (0.4F + 0.6F * light);
    case Overlay::None:
        break;
    }
    return shaded;
}

void Shading::shadeRow(int y, std::span<const std::uint64_t> words, Rgb* colors, SurfaceSample* surfaces) const {
    Corners at;
    std::uint64_t last = 0; // the word that `at` was made for
    for (std::size_t x = 0; x < words.size(); ++x) {
        if (words[x] == 0) continue;
        const std::uint32_t triangle = raster::visibleTriangle(words[x]);
        if (last == 0 || raster::visibleTriangle(last) != triangle) at = corners(triangle);
        last = words[x];
        const ShadedPixel shaded = shade(at, static_cast<int>(x), y);
        colors[x] = shaded.color;
        if (surfaces != nullptr) surfaces[x] = shaded.surface;
    }
}

Shading::ShadedPixel Shading::shade(const Corners& at, int x, int y) const {
    const Surface s = surface(at, x, y);
    const glm::vec3 light(block_.light);
    const float cosine = glm::dot(s.flatNormal, light);
    float lit = 0;
    int index = -1;
    if (cosine > 0) {
        lit = 1;
        if (hasMaps_) {
            index = partitionOf(s.position - glm::vec3(block_.eye), s.depth);
            lit = litFraction(index, s.position, s.flatNormal, cosine);
        } else if (frame_->litMask != nullptr) {
            lit = static_cast<float>(frame_->litMask->at(x, frame_->litMask->height - 1 - y)) / 255.0F;
        }
    }
    const float direct = lit * std::max(glm::dot(s.smoothNormal, light), 0.0F);
    const glm::vec3 towardsEye = glm::normalize(glm::vec3(block_.eye) - s.position);
    const float facing = std::abs(glm::dot(s.smoothNormal, towardsEye));
    const glm::vec3 shaded = overlaid(s.color * (0.22F + 0.14F * facing + 0.64F * direct), at, s, index);
    return {
        {level(shaded.r), level(shaded.g), level(shaded.b)},
        {s.flatNormal, cosine > 0 ? static_cast<float>(index + 1) + 0.5F * lit : -1.0F}};
}

} // namespace gnomon::render
