#include "bench/exact_depth.h"

#include "render/frame_block.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::render {

namespace {

using Corners = std::array<glm::dvec4, 3>; // corners of a triangle in clip space, with depths from 0 to w

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Returns the homogeneous barycentric weights of the point `at` in the triangle `corners`. `at` is a point in
/// normalised device coordinates, that is, x / w and y / w.
glm::dvec3 weights(const Corners& corners, const glm::dvec2& at) {
    std::array<glm::dvec2, 3> from{};
    for (std::size_t i = 0; i < 3; ++i)
        from[i] = glm::dvec2(corners[i]) - at * corners[i].w;
    return {cross(from[1], from[2]), cross(from[2], from[0]), cross(from[0], from[1])};
}

/// Returns the sum of the corners, weighted with `b`.
glm::dvec4 weighted(const Corners& corners, const glm::dvec3& b) {
    return corners[0] * b.x + corners[1] * b.y + corners[2] * b.z;
}

/// Returns true if the triangle `corners` covers the point `at` in front of the light's near plane (w > 0).
bool covers(const Corners& corners, const glm::dvec2& at) {
    const glm::dvec3 b = weights(corners, at);
    const bool isInside = (b.x >= 0 && b.y >= 0 && b.z >= 0) || (b.x <= 0 && b.y <= 0 && b.z <= 0);
    const double sum = b.x + b.y + b.z;
    return isInside && sum != 0 && weighted(corners, b).w / sum > 0;
}

/// Returns true if the triangle covers `at` or one of eight points around it. Their distances are `reach` in x and y.
bool isNear(const Corners& corners, const glm::dvec2& at, const glm::dvec2& reach) {
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            if (covers(corners, at + reach * glm::dvec2(x, y))) return true;
    return false;
}

/// Returns the depth of the triangle's plane at `at`, clamped to [0, 1]. If all corners have w > 0, the depth is also
/// clamped to the range of the corners' depths.
double depthAt(const Corners& corners, const glm::dvec2& at) {
    const glm::dvec4 p = weighted(corners, weights(corners, at));
    double depth = p.z / p.w;
    const bool isBefore = std::all_of(corners.begin(), corners.end(), [](const glm::dvec4& c) { return c.w > 0; });
    if (isBefore) {
        const auto [minDepth, maxDepth] =
            std::minmax({corners[0].z / corners[0].w, corners[1].z / corners[1].w, corners[2].z / corners[2].w});
        depth = std::clamp(depth, minDepth, maxDepth);
    }
    return std::clamp(depth, 0.0, 1.0);
}

/// Compares the depths of some texels with the exact planes of the casters of one shadow map.
class Judge {
public:
    Judge(const DrawInputs& frame, const plan::ShadowPass& pass, std::vector<DisputedTexel>& texels)
        : map_(mapDrawing(frame, pass.map)), clip_(map_.clipFromDraw()), texels_(&texels) {
        const shadow::TexelRectangle& r = pass.map.rectangle;
        for (const DisputedTexel& texel : texels)
            places_.emplace_back(2 * (texel.x + 0.5 - r.x) / r.width - 1, 2 * (texel.y + 0.5 - r.y) / r.height - 1);
        constexpr double kReach = 1.5 / 256;
        reach_ = {2 * kReach / r.width, 2 * kReach / r.height};
    }

    /// Updates the depth errors of all texels with the triangles of `cluster`.
    void look(const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
        corners_.clear();
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
            const hierarchy::GridPoint& p = page.vertices[cluster.firstVertex + v].position;
            const glm::ivec3 cells =
                glm::ivec3(p.x, p.y, p.z) -
                glm::ivec3(map_.space.originCell.x, map_.space.originCell.y, map_.space.originCell.z);
            corners_.push_back(clip_ * glm::dvec4(glm::dvec3(glm::vec3(cells)) * map_.space.step, 1));
        }
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            const hierarchy::Triangle& triangle = page.triangles[cluster.firstTriangle + t];
            look({corners_[triangle[0]], corners_[triangle[1]], corners_[triangle[2]]});
        }
    }

private:
    /// Updates the depth errors of the texels that the triangle `corners` covers.
    void look(const Corners& corners) {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const glm::dvec2& at = places_[i];
            if (isBeside(corners, at) || !isNear(corners, at, reach_)) continue;
            const double depth = depthAt(corners, at);
            DisputedTexel& texel = (*texels_)[i];
            texel.oursOff = std::min(texel.oursOff, std::abs(texel.ours - depth));
            texel.theirsOff = std::min(texel.theirsOff, std::abs(texel.theirs - depth));
        }
    }

    /// Returns true if all corners are left, right, above or below of `at` and its neighbours. The triangle then cannot
    /// cover them. This fast test rejects most triangles.
    bool isBeside(const Corners& corners, const glm::dvec2& at) const {
        const auto all = [&](const auto& isOut) { return isOut(corners[0]) && isOut(corners[1]) && isOut(corners[2]); };
        if (!all([](const glm::dvec4& c) { return c.w > 0; })) return false;
        const glm::dvec2 low = at - 2.0 * reach_;
        const glm::dvec2 high = at + 2.0 * reach_;
        return all([&](const glm::dvec4& c) { return c.x < low.x * c.w; }) ||
               all([&](const glm::dvec4& c) { return c.x > high.x * c.w; }) ||
               all([&](const glm::dvec4& c) { return c.y < low.y * c.w; }) ||
               all([&](const glm::dvec4& c) { return c.y > high.y * c.w; });
    }

    MapDrawing map_;
    glm::dmat4 clip_; // clip space from draw space; the values are the floats that both backends use
    std::vector<DisputedTexel>* texels_;
    std::vector<glm::dvec2> places_;  // centres of the texels, in normalised device coordinates
    glm::dvec2 reach_{0};             // 1.5/256 texel, in normalised device coordinates
    std::vector<glm::dvec4> corners_; // vertices of the current cluster, in clip space
};

} // namespace

void judge(const DrawInputs& frame, std::size_t pass, std::vector<DisputedTexel>& texels) {
    Judge judge(frame, frame.plan->passes[pass], texels);
    for (const lod::ClusterRange& range : frame.casters[pass]->ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            judge.look(page, page.clusters[c]);
    }
}

} // namespace gnomon::render
