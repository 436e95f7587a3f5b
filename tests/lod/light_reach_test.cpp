// What bounds penumbrae and what may hide the sky, against loops over all pairs.
#include "lod/open_sky.h"
#include "lod/penumbra_width.h"
#include "seen_scene.h"
#include "shadow/image_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon::lod {
namespace {

std::array<glm::dvec3, 8> boxCornersOf(const Box& box) {
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            corners[i][axis] = (i >> static_cast<unsigned>(axis) & 1U) != 0 ? box.max[axis] : box.min[axis];
    return corners;
}

/// From where to where corners reach along an axis.
struct AxisReach {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

AxisReach reachAlong(const Box& box, const glm::dvec3& axis) {
    AxisReach reach;
    for (const glm::dvec3& corner : boxCornersOf(box)) {
        reach.low = std::min(reach.low, glm::dot(axis, corner));
        reach.high = std::max(reach.high, glm::dot(axis, corner));
    }
    return reach;
}

std::vector<Box> drawnBoxes(const lod::CutQuery& query, const lod::DrawList& list) {
    std::vector<Box> boxes;
    forEveryCluster(query, list, [&](const hierarchy::Page&, const hierarchy::Cluster& cluster) {
        boxes.push_back(query.trees->grid().local(cluster.box));
    });
    return boxes;
}

/// A receiver and the widest penumbra that can fall on it.
struct WidthOfBox {
    Box box;
    double width = 0;
};

/// Of all triangles of the image that may be seen and lit, by all pairs with `boxes`.
std::vector<WidthOfBox> widthsOfPairs(
    const Seen& seen, const std::vector<Box>& boxes, const DiscLight& light, const TiledView& image) {
    // Two directions across the light, the same as those whose overlap is asked for.
    glm::dvec3 other(0);
    other[std::abs(light.towards.x) < 0.5 ? 0 : 1] = 1;
    const glm::dvec3 right = glm::normalize(glm::cross(other, light.towards));
    const std::array axes = {right, glm::cross(light.towards, right)};
    const auto shareABeam = [&](const Box& caster, const Box& receiver, double before) {
        return std::all_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
            const AxisReach a = reachAlong(caster, axis);
            const AxisReach b = reachAlong(receiver, axis);
            const double spread = 0.5 * light.slope * before;
            return a.high >= b.low - spread && a.low <= b.high + spread;
        });
    };
    const lod::DetailView& view = seen.view;
    const double aslant = std::sqrt(1 + view.tanHalfX * view.tanHalfX + view.tanHalfY * view.tanHalfY);
    const ConvexVolume pyramid = lod::viewPyramid(view);
    std::vector<WidthOfBox> found;
    forEveryTriangle(seen.query(), seen.cut.lists.image, [&](const auto& corners, const auto&, const auto& cluster) {
        if (classify(pyramid, seen.query().trees->grid().local(cluster.box)) == Containment::Outside) return;
        Box receiver;
        for (const glm::dvec3& corner : corners)
            receiver.add(corner);
        const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const glm::dvec3 towardsEye = image.isParallel ? -view.basis.view : view.eye - corners[0];
        const double side = glm::dot(normal, towardsEye) < 0 ? -1 : 1;
        if (side * glm::dot(normal, light.towards) < -light.slope / 2 - 2e-6) return; // in the dark
        const AxisReach depths = reachAlong(receiver, view.basis.view);
        const double eyeDepth = glm::dot(view.basis.view, view.eye);
        if (depths.high - eyeDepth < image.nearest) return;
        const double pixel = 2 * view.tanHalfY / view.heightPixels * std::max(depths.low - eyeDepth, image.nearest);
        found.push_back({receiver});
        for (const Box& caster : boxes) {
            const double before = reachAlong(caster, light.towards).high - reachAlong(receiver, light.towards).low;
            const double width = light.slope * before * aslant / pixel;
            if (width > found.back().width && shareABeam(caster, receiver, before)) found.back().width = width;
        }
    });
    return found;
}

/// Where a point is seen, in pixels from the lower left corner; nothing if nearer than `seen` shows.
std::optional<glm::dvec2> seenPixel(const lod::DetailView& view, const TiledView& seen, const glm::dvec3& point) {
    const glm::dvec3 way = point - view.eye;
    const double depth = glm::dot(view.basis.view, way);
    if (depth < seen.nearest) return std::nullopt;
    const glm::dvec2 across(glm::dot(view.basis.right, way), glm::dot(view.basis.up, way));
    const glm::dvec2 place = across / (seen.half * (seen.isParallel ? 1 : depth));
    return (place + 1.0) / 2.0 * glm::dvec2(seen.tiles.width, seen.tiles.height);
}

/// Between the corners of a box, in pixels; everywhere, where one of them is nearer than is shown.
struct CornerReach {
    glm::dvec2 min{1e9};
    glm::dvec2 max{-1e9};

    CornerReach(const lod::DetailView& view, const TiledView& seen, const Box& box) {
        for (const glm::dvec3& corner : boxCornersOf(box)) {
            const auto pixel = seenPixel(view, seen, corner);
            min = pixel ? glm::min(min, *pixel) : glm::dvec2(-1e9);
            max = pixel ? glm::max(max, *pixel) : glm::dvec2(1e9);
        }
    }

    /// Whether it reaches within two pixels of a tile.
    bool touches(int x, int y) const {
        constexpr int kSide = shadow::ImageTiles::kSide;
        return max.x >= x - 2 && max.y >= y - 2 && min.x <= x + kSide + 2 && min.y <= y + kSide + 2;
    }
};

/// Holds the tiles to a box that points of are seen in them.
void expectReached(
    Random& random,
    const Seen& seen,
    const TiledView& image,
    const WidthOfBox& receiver,
    const std::vector<double>& widths) {
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 part(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const auto pixel = seenPixel(seen.view, image, receiver.box.min + receiver.box.extent() * part);
        if (!pixel) continue;
        const glm::dvec2 sampled = *pixel + glm::dvec2(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
        const glm::ivec2 at(glm::floor(sampled));
        if (at.x < 0 || at.y < 0 || at.x >= image.tiles.width || at.y >= image.tiles.height) continue;
        EXPECT_GE(widths[image.tiles.at(at.x, at.y)], receiver.width * (1 - 1e-9));
    }
}

/// Holds each tile to the widest of the boxes that it may show.
void expectNoMore(
    const Seen& seen,
    const TiledView& image,
    const std::vector<WidthOfBox>& receivers,
    const std::vector<double>& widths) {
    std::vector<double> max(image.tiles.count());
    for (const WidthOfBox& each : receivers) {
        const CornerReach reach(seen.view, image, each.box);
        for (int y = 0; y < image.tiles.height; y += shadow::ImageTiles::kSide)
            for (int x = 0; x < image.tiles.width; x += shadow::ImageTiles::kSide) {
                double& width = max[image.tiles.at(x, y)];
                if (reach.touches(x, y)) width = std::max(width, each.width);
            }
    }
    for (std::size_t i = 0; i < max.size(); ++i)
        EXPECT_LE(widths[i], max[i] * (1 + 1e-9)) << i;
}

TEST(PenumbraWidths, AreThoseOfTheFarthestPairsThatShareABeamTileByTile) {
    Random random(31);
    int found = 0;
    int apart = 0;
    for (int round = 0; round < 16; ++round) {
        const Seen seen(random);
        const lod::CutQuery query = seen.query();
        const DiscLight light{
            glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1))),
            random.uniform(0.005, 0.2)};
        TiledView image;
        image.tiles = {300, 200};
        image.isParallel = round % 4 == 3;
        image.half = {seen.view.tanHalfX, seen.view.tanHalfY};
        if (image.isParallel) image.half *= glm::length(tests::sharedModel().bounds.center() - seen.view.eye);
        image.nearest = random.uniform(0.5, 2);
        const lod::DrawList& list = seen.cut.lists.image;
        const auto receivers = widthsOfPairs(seen, drawnBoxes(query, list), light, image);
        const std::vector<double> widths = penumbraWidths(query, list, {}, light, image);
        for (const WidthOfBox& receiver : receivers)
            expectReached(random, seen, image, receiver, widths);
        expectNoMore(seen, image, receivers, widths);
        EXPECT_EQ(penumbraWidths(query, list, std::span(&list, 1), light, image), widths)
            << "a caster that is seen, too, is one";
        const auto [min, max] = std::minmax_element(widths.begin(), widths.end());
        found += *max > 0 ? 1 : 0;
        apart += *min < 0.5 * *max ? 1 : 0;
    }
    EXPECT_GT(found, 6);
    EXPECT_GT(apart, 3);
}

TEST(MayHideSky, IsSureOnlyWhereNothingLiesBeforeAnyTriangle) {
    Random random(32);
    int hidden = 0;
    for (int round = 0; round < 8; ++round) {
        const Seen seen(random);
        const lod::CutQuery query = seen.query();
        const Box& bounds = tests::sharedModel().bounds;
        bool isHidden = false;
        forEveryTriangle(query, seen.cut.lists.image, [&](const auto& corners, const auto&, const auto&) {
            glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            if (glm::length(normal) == 0) return;
            if (glm::dot(normal, seen.view.eye - corners[0]) < 0) normal = -normal;
            for (const glm::dvec3& corner : boxCornersOf(bounds))
                isHidden |=
                    glm::dot(normal, corner - corners[0]) > glm::length(normal) * 2 * query.trees->grid().step();
        });
        // Where the box of all that there is lies behind every triangle nothing is hidden; a wavy ground may hide some.
        if (!isHidden) {
            EXPECT_FALSE(mayHideSky(query, seen.cut.lists.image, bounds, Solids::Whole));
        }
        if (mayHideSky(query, seen.cut.lists.image, bounds, Solids::Whole)) ++hidden;
    }
    EXPECT_GT(hidden, 0);
}

} // namespace
} // namespace gnomon::lod
