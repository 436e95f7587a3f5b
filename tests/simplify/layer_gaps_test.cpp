// Parts and layers of different colours: no face takes another part's colour, and no layer comes before another.
#include "preprocess/simplify/color_charge.h"
#include "preprocess/simplify/layer_gaps.h"
#include "preprocess/simplify/simplify.h"
#include "tests/support/patches.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::simplify {
namespace {

constexpr std::uint32_t kWall = 0xFFF0F0F0U;
constexpr std::uint32_t kRoof = 0xFF2828B4U;
constexpr std::uint32_t kSlab = 0xFF1EC8F0U;

/// Parts whose faces have vertices of their own; positions are welded.
class Parts {
public:
    void addQuad(
        const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, std::uint32_t color, int cells = 1) {
        const auto vertexAt = [&](int i, int k) {
            return add(origin + u * (static_cast<double>(i) / cells) + v * (static_cast<double>(k) / cells), color);
        };
        for (int i = 0; i < cells; ++i)
            for (int k = 0; k < cells; ++k) {
                const Triangle t{vertexAt(i, k), vertexAt(i + 1, k), vertexAt(i + 1, k + 1)};
                patch.triangles.push_back(t);
                patch.triangles.push_back({t[0], t[2], vertexAt(i, k + 1)});
            }
    }

    void addBox(const glm::dvec3& low, const glm::dvec3& high, std::uint32_t color, int cells = 1) {
        const glm::dvec3 x(high.x - low.x, 0, 0);
        const glm::dvec3 y(0, high.y - low.y, 0);
        const glm::dvec3 z(0, 0, high.z - low.z);
        addQuad(low, y, x, color, cells);
        addQuad(low + z, x, y, color, cells);
        addQuad(low, x, z, color);
        addQuad(low + y, z, x, color);
        addQuad(low, z, y, color);
        addQuad(low + x, y, z, color);
    }

    Patch patch;

private:
    std::uint32_t add(const glm::dvec3& p, std::uint32_t color) {
        const auto known = std::ranges::find(patch.positions, p);
        const auto position = static_cast<std::uint32_t>(known - patch.positions.begin());
        for (std::uint32_t v = 0; v < patch.vertices.size(); ++v)
            if (patch.positionOf[v] == position && patch.vertices[v].color == color) return v;
        if (known == patch.positions.end()) {
            patch.positions.push_back(p);
            patch.isLocked.push_back(0);
        }
        Vertex vertex;
        vertex.color = color;
        patch.vertices.push_back(vertex);
        patch.positionOf.push_back(position);
        return static_cast<std::uint32_t>(patch.vertices.size() - 1);
    }
};

/// Houses of 10 m in steps of a millimetre, each with a roof and a slab of 1 cm on it.
Patch houses() {
    Parts parts;
    for (int i = 0; i < 5; ++i) {
        const double x = 13000.0 * i;
        parts.addBox({x, 0, 0}, {x + 10000, 8000, 6000}, kWall);
        parts.addBox({x, 0, 6000}, {x + 10000, 8000, 6200}, kRoof);
        parts.addBox({x, 0, 6200}, {x + 10000, 8000, 6210}, kSlab);
    }
    return parts.patch;
}

TEST(LayerGaps, AFaceKeepsTheColourOfItsPart) {
    const Patch patch = houses();
    for (const std::size_t share : {2U, 4U, 8U}) {
        const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / share);
        EXPECT_LT(simplified.triangles.size(), patch.triangles.size());
        for (std::size_t t = 0; t < simplified.triangles.size(); ++t)
            for (const std::uint32_t v : simplified.triangles[t])
                EXPECT_EQ(patch.vertices[v].color, patch.vertices[patch.triangles[simplified.origin[t]][0]].color)
                    << "triangle " << t << " of one in " << share;
    }
}

TEST(LayerGaps, TellHowFarLayersAreApart) {
    Parts parts;
    parts.addQuad({0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}, kRoof);
    parts.addQuad({200, 200, 40}, {500, 0, 0}, {0, 500, 0}, kSlab);
    const std::vector<LayerGap> gaps = layerGaps(parts.patch);
    ASSERT_EQ(gaps.size(), 4U);
    for (const LayerGap& gap : gaps) {
        EXPECT_LT(gap.reach, 20);
        EXPECT_GT(gap.reach, 15);
        EXPECT_GT(gap.charge, 100);
    }
}

TEST(LayerGaps, FacesThatFaceEachOtherAreNoLayers) {
    Parts parts;
    parts.addQuad({0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}, kRoof);
    parts.addQuad({0, 0, 40}, {0, 1000, 0}, {1000, 0, 0}, kSlab);
    for (const LayerGap& gap : layerGaps(parts.patch))
        EXPECT_EQ(gap.charge, 0);
}

TEST(LayerGaps, TheSidesOfASheetOfTwoColoursAreLayers) {
    Parts parts;
    parts.addQuad({0, 0, 40}, {1000, 0, 0}, {0, 1000, 0}, kRoof);
    parts.addQuad({0, 0, 0}, {0, 1000, 0}, {1000, 0, 0}, kSlab);
    for (const LayerGap& gap : layerGaps(parts.patch))
        EXPECT_GT(gap.charge, 0);
}

TEST(LayerGaps, OneColourHasNone) {
    Parts parts;
    parts.addBox({0, 0, 0}, {1000, 1000, 10}, kRoof);
    EXPECT_TRUE(layerGaps(parts.patch).empty());
}

/// The colour that is seen from above at (x, y) of `triangles`, the slow way; 0 if none is there.
std::uint32_t seenFromAbove(
    const Patch& patch, const SimplifiedPatch& simplified, const std::vector<Triangle>& triangles, double x, double y) {
    double highest = -1;
    std::uint32_t color = 0;
    for (const Triangle& t : triangles) {
        std::array<glm::dvec3, 3> p{};
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = patch.positions[simplified.positionOf(patch, t[i])];
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (normal.z == 0) continue;
        int left = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& a = p[i];
            const glm::dvec3& b = p[(i + 1) % 3];
            left += (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0 ? 1 : -1;
        }
        if (left != 3 && left != -3) continue;
        const double z = p[0].z - ((x - p[0].x) * normal.x + (y - p[0].y) * normal.y) / normal.z;
        if (z <= highest) continue;
        highest = z;
        color = patch.vertices[t[0]].color;
    }
    return color;
}

TEST(LayerGaps, WhatIsSeenFromAboveStaysUnlessItIsCharged) {
    const Patch patch = houses();
    SimplifiedPatch same;
    for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
        same.movedTo.push_back(p);
    for (const std::size_t share : {2U, 3U, 6U, 12U, 30U}) {
        const SimplifiedPatch simplified = simplifyQuadric(patch, patch.triangles.size() / share);
        int wrong = 0;
        int points = 0;
        for (double x = 91; x < 62000; x += 500)
            for (double y = 33; y < 8000; y += 400) {
                const std::uint32_t wanted = seenFromAbove(patch, same, patch.triangles, x, y);
                const std::uint32_t found = seenFromAbove(patch, simplified, simplified.triangles, x, y);
                ++points;
                if (wanted != 0 && found != 0 && wanted != found) ++wrong;
            }
        const double worst = std::ranges::max(simplified.errors, {}, &TriangleError::fromSource).fromSource;
        const double charged = std::max(simplified.layerCharge, worst);
        const double width = 500 * std::sqrt(wrong / 5.0); // of a square region on each house
        EXPECT_LE(width, 2 * std::max(charged, 500.0)) << "one in " << share << ", wrong " << wrong << " of " << points;
    }
}

} // namespace
} // namespace gnomon::simplify
