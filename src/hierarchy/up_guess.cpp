#include "hierarchy/up_guess.h"

#include "core/box.h"
#include "hierarchy/cut_rule.h"
#include "hierarchy/grid.h"
#include "hierarchy/up_features.h"
#include "hierarchy/up_trees.h"

#include <algorithm>
#include <cmath>

namespace gnomon::hierarchy {

namespace {

UpAxis axisOf(std::size_t direction) {
    UpAxis up;
    up.direction = glm::dvec3(0);
    up.direction[static_cast<int>(direction / 2)] = direction % 2 == 1 ? -1 : 1;
    return up;
}

/// Returns the votes that a decision tree gives to a direction with the feature values `numbers`.
int votesOf(const UpTree& tree, const UpNumbers& numbers) {
    std::size_t node = 0;
    while (node < tree.features.size())
        node = 2 * node + (numbers[tree.features[node]] < tree.limits[node] ? 1 : 2);
    return tree.votes[node - tree.features.size()];
}

/// Returns the two directions of the list `from` with the most votes. The one with the most votes comes first.
std::pair<std::size_t, std::size_t> leadersOf(const UpVotes& votes, std::vector<std::size_t> from) {
    std::stable_sort(from.begin(), from.end(), [&](std::size_t a, std::size_t b) { return votes[a] > votes[b]; });
    return {from[0], from[1]};
}

/// Returns the up axis of planar survey coordinates, whose values are large on the other two axes. Returns nullopt for
/// other coordinates.
std::optional<UpAxis> upOfMap(const Box& box) {
    constexpr double kFar = 1e5;
    constexpr double kHigh = 9000;
    constexpr double kWidths = 5; // min size of a large coordinate, in extents of the box
    const glm::dvec3 middle = glm::abs(box.center());
    const glm::dvec3 extent = box.extent();
    const double width = std::max({extent.x, extent.y, extent.z});
    for (int axis = 0; axis < 3; ++axis) {
        const double minDistance = std::min(middle[(axis + 1) % 3], middle[(axis + 2) % 3]);
        if (minDistance > kFar && minDistance > kWidths * width && middle[axis] < kHigh)
            return axisOf(2 * static_cast<std::size_t>(axis));
    }
    return {};
}

/// Returns the up direction at an earth-centred position, which is the normal of the WGS84 ellipsoid. The result is
/// exact on the ellipsoid. Its error grows with the height above it.
std::optional<UpAxis> upOfGlobe(const glm::dvec3& at) {
    constexpr double kEquator = 6378137.0;
    constexpr double kFlattening = 1 / 298.257223563;
    constexpr double kNear = 1e4;
    // The squared ratio of the Earth's polar radius to its equatorial radius.
    constexpr double kPoleRatio = (1 - kFlattening) * (1 - kFlattening);
    const double radius = glm::length(at);
    if (!(radius > 0)) return {};
    const double sine = at.z / radius;
    const double surface = kEquator / std::sqrt(1 + (1 / kPoleRatio - 1) * sine * sine);
    if (std::abs(radius - surface) > kNear) return {};
    return UpAxis{glm::normalize(glm::dvec3(at.x, at.y, at.z / kPoleRatio))};
}

} // namespace

std::optional<UpGuess> upOfPlace(const Box& box) {
    if (box.isEmpty()) return {};
    if (const auto up = upOfMap(box))
        return UpGuess{*up, "by its coordinates, which are large on the two other axes", UpConfidence::Sure};
    if (const auto up = upOfGlobe(box.center()))
        return UpGuess{*up, "by its coordinates, which are earth-centred", UpConfidence::Sure};
    return {};
}

UpSurvey::UpSurvey(const Grid& grid, const Box& part)
    : part_(part), origin_(part.isEmpty() ? glm::dvec3(0) : grid.origin - part.center()), step_(grid.step()) {}

void UpSurvey::add(const Page& page, double error) {
    const glm::dvec3 half = 0.5 * part_.extent() + step_;
    const auto isRefined = [error](double groupError, const Sphere&) { return groupError > error; };
    forEachDrawn(page, isRefined, [&](const Group&, const Cluster& cluster) {
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
            std::array<glm::vec3, 3> triangle{};
            bool isWithin = true;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const GridPoint& p = page.vertices[cluster.firstVertex + page.triangles[t][corner]].position;
                const glm::dvec3 at = origin_ + glm::dvec3(p.x, p.y, p.z) * step_;
                isWithin = isWithin && glm::all(glm::lessThanEqual(glm::abs(at), half));
                triangle[corner] = glm::vec3(at);
            }
            if (isWithin) triangles_.push_back(triangle);
        }
    });
}

UpGuess UpSurvey::guess(const UpVotes& votes) const {
    if (const auto found = upOfPlace(part_)) return *found;
    UpVotes sums = votes;
    const std::vector<UpNumbers> numbers = upNumbers(triangles_);
    for (std::size_t direction = 0; direction < numbers.size(); ++direction)
        for (const UpTree& tree : kUpTrees)
            sums[direction] += votesOf(tree, numbers[direction]);
    const auto [first, second] = leadersOf(sums, {0, 1, 2, 3, 4, 5});
    if (sums[first] - sums[second] >= kSureVotes) return {axisOf(first), "by its shape", UpConfidence::Sure};
    constexpr std::size_t kY = 2;
    constexpr std::size_t kZ = 4;
    const std::size_t likely = leadersOf(sums, {kY, kZ}).first;
    const std::size_t other = first == likely ? second : first;
    return {
        axisOf(likely),
        "by its shape, which speaks for " + upAxisText(axisOf(other)) + " as well",
        UpConfidence::Guess};
}

} // namespace gnomon::hierarchy
