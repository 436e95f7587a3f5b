#include "preprocess/levels/normal_transfer.h"

#include "hierarchy/octahedral.h"
#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

constexpr double kLeastAgreement = 0.5; // cosine between normals of one smooth surface

/// The weights of the corners of `t` at the point of it that is about nearest to `p`.
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

std::vector<simplify::Triangle> cornersOf(
    const simplify::Patch& patch, const std::vector<simplify::Triangle>& triangles) {
    std::vector<simplify::Triangle> corners;
    corners.reserve(triangles.size());
    for (const simplify::Triangle& t : triangles)
        corners.push_back(patch.corners(t));
    return corners;
}

class NormalFit {
public:
    NormalFit(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified)
        : patch_(patch),
          simplified_(simplified),
          adjacency_(patch.positions.size(), cornersOf(patch, simplified.triangles)),
          isKept_(patch.vertices.size(), 0),
          area_(patch.vertices.size(), 0) {
        for (const simplify::Triangle& t : simplified.triangles)
            for (const std::uint32_t v : t)
                isKept_[v] = 1;
        normal_.reserve(patch.vertices.size());
        for (const hierarchy::Vertex& vertex : patch.vertices)
            normal_.push_back(hierarchy::unpackNormal(vertex.normal));
        for (const simplify::Triangle& t : patch.triangles) {
            const auto [a, b, c] = corners(t);
            const double area = glm::length(glm::cross(b - a, c - a));
            for (const std::uint32_t v : t)
                area_[v] += area;
        }
    }

    std::vector<TransferredNormal> run() {
        residual_.assign(normal_.size(), glm::dvec3(0));
        weight_ = area_;
        for (std::uint32_t v = 0; v < normal_.size(); ++v)
            if (isKept_[v] == 0 && hasNormal(v)) distributeResidual(v);
        std::vector<TransferredNormal> transferred;
        for (std::uint32_t v = 0; v < normal_.size(); ++v) {
            if (isKept_[v] == 0 || !hasNormal(v) || patch_.isLocked[patch_.positionOf[v]] != 0) continue;
            if (!(weight_[v] > 0)) continue;
            const std::uint32_t packed = hierarchy::packNormal(normal_[v] + residual_[v] / weight_[v]);
            if (packed != hierarchy::kNoNormal) transferred.push_back({v, packed});
        }
        return transferred;
    }

private:
    bool hasNormal(std::uint32_t v) const { return patch_.vertices[v].normal != hierarchy::kNoNormal; }

    std::array<glm::dvec3, 3> corners(const simplify::Triangle& t) const {
        const simplify::Triangle p = patch_.corners(t);
        return {patch_.positions[p[0]], patch_.positions[p[1]], patch_.positions[p[2]]};
    }

    /// The triangle nearest to where the vertices at `position` were, among those around what they collapsed into.
    std::uint32_t nearestTriangle(std::uint32_t position) {
        std::uint32_t nearest = kNone;
        double best = std::numeric_limits<double>::infinity();
        const std::span<const std::uint32_t> around = adjacency_.around(simplified_.movedTo[position]);
        for (std::size_t first = 0; first < around.size(); first += proximity::TriangleBatch::kCapacity) {
            const auto some =
                around.subspan(first, std::min(proximity::TriangleBatch::kCapacity, around.size() - first));
            batch_.clear();
            for (const std::uint32_t t : some) {
                const auto [a, b, c] = corners(simplified_.triangles[t]);
                batch_.add(a, b, c);
            }
            batch_.squaredDistances(patch_.positions[position], squares_);
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (squares_[i] >= best) continue;
                best = squares_[i];
                nearest = some[i];
            }
        }
        return nearest;
    }

    /// Divides the residual at a removed vertex among the corners of the triangle there.
    void distributeResidual(std::uint32_t v) {
        const std::uint32_t position = patch_.positionOf[v];
        const std::uint32_t triangle = nearestTriangle(position);
        if (triangle == kNone) return;
        const simplify::Triangle& t = simplified_.triangles[triangle];
        glm::dvec3 weights = weightsAt(patch_.positions[position], corners(t));
        double sum = 0;
        glm::dvec3 found(0);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3& normal = normal_[t[static_cast<std::size_t>(i)]];
            if (glm::dot(normal, normal_[v]) < kLeastAgreement) weights[i] = 0;
            found += normal * weights[i];
            sum += weights[i];
        }
        if (!(sum > 0)) return;
        const glm::dvec3 residual = normal_[v] - found / sum;
        for (int i = 0; i < 3; ++i) {
            const double area = area_[v] * weights[i] / sum;
            residual_[t[static_cast<std::size_t>(i)]] += residual * area;
            weight_[t[static_cast<std::size_t>(i)]] += area;
        }
    }

    const simplify::Patch& patch_;
    const simplify::SimplifiedPatch& simplified_;
    simplify::TriangleAdjacency adjacency_;
    proximity::TriangleBatch batch_;
    proximity::TriangleBatch::Row squares_{};
    std::vector<std::uint8_t> isKept_;
    std::vector<double> area_;         // six times what a vertex has of its faces
    std::vector<glm::dvec3> normal_;   // zero for none
    std::vector<glm::dvec3> residual_; // times the area where it residual
    std::vector<double> weight_;       // all of the area that the vertex now represents
};

} // namespace

std::vector<TransferredNormal> transferredNormals(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    const bool hasNormals =
        std::any_of(patch.vertices.begin(), patch.vertices.end(), [](const hierarchy::Vertex& vertex) {
            return vertex.normal != hierarchy::kNoNormal;
        });
    if (!hasNormals) return {};
    return NormalFit(patch, simplified).run();
}

} // namespace gnomon::levels
