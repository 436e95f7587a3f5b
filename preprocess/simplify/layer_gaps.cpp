#include "preprocess/simplify/layer_gaps.h"

#include "preprocess/proximity/box_tree.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/color_charge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace gnomon::simplify {

namespace {

constexpr double kParallel = 0.7;    // min cosine between the normals of layers
constexpr double kReachShare = 0.45; // share of the gap between two layers by which each layer may move without contact
// A triangle whose area exceeds this multiple of the mean area is tested at more points than its centre.
constexpr double kLargeArea = 16;

using Weights = std::array<double, 3>;

constexpr std::array<Weights, 4> kPoints = {
    {{1.0 / 3, 1.0 / 3, 1.0 / 3},
     {2.0 / 3, 1.0 / 6, 1.0 / 6},
     {1.0 / 6, 2.0 / 3, 1.0 / 6},
     {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

struct Side {
    std::array<glm::dvec3, 3> corners{};
    Triangle positions{};
    glm::dvec3 normal{}; // unit length; zero if the triangle has no area
    double area = 0;     // twice the area
    double width = 0;    // the smallest height of the triangle
    std::uint32_t triangle = 0;
};

Side sideOf(const Patch& patch, const Triangle& t) {
    Side side;
    side.positions = patch.corners(t);
    for (std::size_t i = 0; i < 3; ++i)
        side.corners[i] = patch.positions[side.positions[i]];
    const auto& [a, b, c] = side.corners;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    side.area = glm::length(normal);
    side.normal = side.area > 0 ? normal / side.area : glm::dvec3(0);
    const double longest = std::sqrt(
        std::max({proximity::squaredLength(b - a), proximity::squaredLength(c - b), proximity::squaredLength(a - c)}));
    side.width = longest > 0 ? side.area / longest : 0;
    return side;
}

bool touch(const Side& a, const Side& b) {
    return std::ranges::any_of(a.positions, [&](std::uint32_t p) {
        return p == b.positions[0] || p == b.positions[1] || p == b.positions[2];
    });
}

/// Returns true if the line through `p` along `direction` intersects the triangle `side`.
bool intersects(const Side& side, const glm::dvec3& p, const glm::dvec3& direction) {
    std::array<double, 3> turn{};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = side.corners[i] - p;
        const glm::dvec3 b = side.corners[(i + 1) % 3] - p;
        turn[i] = glm::dot(glm::cross(a, b), direction);
    }
    return (turn[0] >= 0 && turn[1] >= 0 && turn[2] >= 0) || (turn[0] <= 0 && turn[1] <= 0 && turn[2] <= 0);
}

/// Returns the distance of the triangle `other` from the point `p` of `side`, along the normal of `side`. Returns
/// nullopt if `other` is not a layer (a nearby parallel face) at this point.
std::optional<double> distanceToLayer(const Side& side, const Side& other, const glm::dvec3& p) {
    const double cosine = glm::dot(side.normal, other.normal);
    if (std::abs(cosine) < kParallel || touch(side, other)) return std::nullopt;
    const double ahead = glm::dot(other.corners[0] - p, other.normal) / cosine;
    if ((cosine < 0 && ahead >= 0) || std::abs(ahead) > side.width || !intersects(other, p, side.normal))
        return std::nullopt;
    return std::abs(ahead);
}

void take(LayerGap& gap, const Side& side, double distance, double difference) {
    gap.reach = std::min(gap.reach, static_cast<float>(kReachShare * distance));
    gap.charge = std::max(gap.charge, static_cast<float>(colorCharge(0.5 * side.width, difference)));
}

/// The triangles of a patch that have an area and the same colour at all corners.
struct ColoredSides {
    std::vector<Side> sides;
    std::vector<std::uint32_t> colors;
    double area = 0; // sum of the areas of `sides`
};

ColoredSides coloredSides(const Patch& patch) {
    ColoredSides result;
    for (std::uint32_t t = 0; t < patch.triangles.size(); ++t) {
        const auto& [a, b, c] = patch.triangles[t];
        const std::uint32_t color = patch.vertices[a].color;
        if (patch.vertices[b].color != color || patch.vertices[c].color != color) continue;
        const Side side = sideOf(patch, patch.triangles[t]);
        if (!(side.area > 0)) continue;
        result.sides.push_back(side);
        result.sides.back().triangle = t;
        result.colors.push_back(color);
        result.area += side.area;
    }
    return result;
}

} // namespace

std::vector<LayerGap> layerGaps(const Patch& patch) {
    const ColoredSides colored = coloredSides(patch);
    const std::vector<Side>& sides = colored.sides;
    const std::vector<std::uint32_t>& colors = colored.colors;
    if (std::ranges::all_of(colors, [&](std::uint32_t color) { return color == colors.front(); })) return {};
    std::vector<proximity::TreeBox> boxes(sides.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const glm::dvec3& p : sides[i].corners)
            boxes[i].add(p);
    const double large = kLargeArea * colored.area / static_cast<double>(sides.size());
    const proximity::BoxTree tree(boxes, colors);
    std::vector<LayerGap> gaps(patch.triangles.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side& side = sides[i];
        for (const Weights& at : std::span(kPoints).first(side.area > large ? kPoints.size() : 1)) {
            const glm::dvec3 p = side.corners[0] * at[0] + side.corners[1] * at[1] + side.corners[2] * at[2];
            proximity::TreeBox box;
            box.add(p - side.normal * side.width);
            box.add(p + side.normal * side.width);
            tree.forEachOther(box, colors[i], [&](std::uint32_t k) {
                const Side& other = sides[k];
                const double difference = colorDifference(colors[i], colors[k]);
                if (difference <= kUnseenDifference) return;
                const std::optional<double> distance = distanceToLayer(side, other, p);
                if (!distance) return;
                take(gaps[side.triangle], side, *distance, difference);
                take(gaps[other.triangle], other, *distance, difference);
            });
        }
    }
    return gaps;
}

} // namespace gnomon::simplify
