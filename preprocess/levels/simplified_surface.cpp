#include "preprocess/levels/simplified_surface.h"

#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <limits>

namespace gnomon::levels {

namespace {

std::vector<simplify::Triangle> cornersOf(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    std::vector<simplify::Triangle> corners;
    corners.reserve(simplified.triangles.size());
    for (const simplify::Triangle& t : simplified.triangles)
        corners.push_back(simplified.corners(patch, t));
    return corners;
}

} // namespace

glm::dvec3 weightsAt(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    glm::dvec3 weights(0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& a = t[static_cast<std::size_t>((i + 1) % 3)];
        const glm::dvec3& b = t[static_cast<std::size_t>((i + 2) % 3)];
        weights[i] = std::max(glm::dot(glm::cross(b - a, p - a), normal), 0.0);
    }
    const double sum = weights.x + weights.y + weights.z;
    return sum > 0 ? weights / sum : glm::dvec3(1.0 / 3);
}

SimplifiedSurface::SimplifiedSurface(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified)
    : patch_(patch), simplified_(simplified), adjacency_(patch.positions.size(), cornersOf(patch, simplified)) {}

std::uint32_t SimplifiedSurface::nearest(const glm::dvec3& p, std::span<const std::uint32_t> among) {
    std::uint32_t nearest = hierarchy::kNone;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < among.size(); first += proximity::TriangleBatch::kCapacity) {
        const auto some = among.subspan(first, std::min(proximity::TriangleBatch::kCapacity, among.size() - first));
        batch_.clear();
        for (const std::uint32_t t : some) {
            const auto [a, b, c] = placesOfSimplified(t);
            batch_.add(a, b, c);
        }
        batch_.squaredDistances(p, squares_);
        for (std::size_t i = 0; i < some.size(); ++i) {
            if (squares_[i] >= best) continue;
            best = squares_[i];
            nearest = some[i];
        }
    }
    return nearest;
}

} // namespace gnomon::levels
