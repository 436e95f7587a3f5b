#include "preprocess/levels/normal_transfer.h"

#include "hierarchy/octahedral.h"
#include "preprocess/levels/simplified_surface.h"

#include <algorithm>
#include <array>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;

constexpr double kMinAgreement = 0.5; // min cosine between normals that affect each other (60 degrees)

class NormalFit {
public:
    NormalFit(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified)
        : patch_(patch),
          simplified_(simplified),
          surface_(patch, simplified),
          isKept_(patch.vertices.size(), 0),
          area_(patch.vertices.size(), 0) {
        for (const simplify::Triangle& t : simplified.triangles)
            for (const std::uint32_t v : t)
                isKept_[v] = 1;
        normal_.reserve(patch.vertices.size());
        for (const hierarchy::Vertex& vertex : patch.vertices)
            normal_.push_back(hierarchy::unpackNormal(vertex.normal));
        for (const simplify::Triangle& t : patch.triangles) {
            const auto [a, b, c] = surface_.placesOf(t);
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
            if (isKept_[v] == 0 || !hasNormal(v) || patch_.isLocked[simplified_.positionOf(patch_, v)] != 0) continue;
            if (!(weight_[v] > 0)) continue;
            const std::uint32_t packed = hierarchy::packNormal(normal_[v] + residual_[v] / weight_[v]);
            if (packed != hierarchy::kNoNormal) transferred.push_back({v, packed});
        }
        return transferred;
    }

private:
    bool hasNormal(std::uint32_t v) const { return patch_.vertices[v].normal != hierarchy::kNoNormal; }

    /// Transfers the normal of the removed vertex `v`. Adds its difference from the simplified surface to the corners
    /// of the nearest simplified triangle.
    void distributeResidual(std::uint32_t v) {
        const std::uint32_t position = patch_.positionOf[v];
        const std::uint32_t triangle = surface_.nearest(patch_.positions[position], surface_.around(position));
        if (triangle == kNone) return;
        const simplify::Triangle& t = simplified_.triangles[triangle];
        glm::dvec3 weights = weightsAt(patch_.positions[position], surface_.placesOfSimplified(triangle));
        double sum = 0;
        glm::dvec3 found(0);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3& normal = normal_[t[static_cast<std::size_t>(i)]];
            if (glm::dot(normal, normal_[v]) < kMinAgreement) weights[i] = 0;
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
    SimplifiedSurface surface_;
    std::vector<std::uint8_t> isKept_;
    std::vector<double> area_;         // per vertex: six times the area of its faces
    std::vector<glm::dvec3> normal_;   // zero if the vertex has no normal
    std::vector<glm::dvec3> residual_; // per vertex: sum of the differences of removed vertices, each times its area
    std::vector<double> weight_;       // per vertex: total area that it represents after the simplification
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
