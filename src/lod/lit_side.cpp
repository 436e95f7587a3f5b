#include "lod/lit_side.h"

#include "lod/triangle_clip.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <cmath>

namespace gnomon::lod {
namespace {

/// Sine of the angle below which the plane of a triangle may contain the light direction or the eye. It is far larger
/// than the rounding errors of a light direction and of the products below.
constexpr double kGrazing = 1e-6;

/// Returns true if a * b equals c * d exactly. All arguments are integers with absolute values below 2^53.
bool areProductsEqual(double a, double b, double c, double d) {
    const double p = a * b;
    const double q = c * d;
    return p == q && std::fma(a, b, -p) == std::fma(c, d, -q);
}

/// Returns true if the plane of a triangle certainly contains the direction `towardsLight`. The function tests only
/// lights along an axis, because walls are often exactly vertical on the grid.
bool holdsLight(const std::array<hierarchy::GridPoint, 3>& corners, const glm::dvec3& towardsLight) {
    const auto cells = [](const hierarchy::GridPoint& p) { return glm::dvec3(p.x, p.y, p.z); };
    const glm::dvec3 ab = cells(corners[1]) - cells(corners[0]);
    const glm::dvec3 ac = cells(corners[2]) - cells(corners[0]);
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3;
        const int j = (axis + 2) % 3;
        if (towardsLight[i] == 0 && towardsLight[j] == 0) return areProductsEqual(ab[i], ac[j], ab[j], ac[i]);
    }
    return false;
}

bool maySeeLitSide(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& towardsLight, const glm::dvec3& eye) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 towardsEye = eye - corners[0];
    const double light = glm::dot(normal, towardsLight);
    const double seen = glm::dot(normal, towardsEye);
    const double grazingLimit = kGrazing * glm::length(normal);
    if (std::abs(light) <= grazingLimit || std::abs(seen) <= grazingLimit * glm::length(towardsEye)) return true;
    return (light > 0) == (seen > 0);
}

} // namespace

bool mayFaceLight(const lod::CutQuery& query, const lod::DrawList& image, const glm::dvec3& towardsLight) {
    const hierarchy::Grid& grid = query.trees->grid();
    const lod::DetailView& view = query.rule->view();
    const ConvexVolume pyramid = lod::viewPyramid(view);
    tbb::enumerable_thread_specific<TriangleClipper> clippers([&] { return TriangleClipper(pyramid); });
    std::atomic<bool> isFound = false;
    const auto faces = [&](const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
        if (classify(pyramid, grid.local(cluster.box)) == Containment::Outside) return false;
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
            std::array<hierarchy::GridPoint, 3> points{};
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i) {
                points[i] = page.vertices[cluster.firstVertex + page.triangles[t][i]].position;
                corners[i] = grid.local(points[i]);
            }
            if (maySeeLitSide(corners, towardsLight, view.eye) && !holdsLight(points, towardsLight) &&
                !clippers.local().clipped(corners).empty())
                return true;
        }
        return false;
    };
    tbb::parallel_for(std::size_t{0}, image.ranges.size(), [&](std::size_t i) {
        const lod::ClusterRange& range = image.ranges[i];
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (isFound.load(std::memory_order_relaxed)) return;
            if (faces(page, page.clusters[c])) isFound.store(true, std::memory_order_relaxed);
        }
    });
    return isFound.load();
}

} // namespace gnomon::lod
