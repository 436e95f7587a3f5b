// Tests for each light direction which points of a list are lit. The points can be anywhere in a model.
#pragma once

#include "core/convex_volume.h"
#include "hierarchy/grid.h"
#include "preprocess/exporter/export.h"
#include "sun/receivers.h"

#include <vector>

namespace gnomon::sun {

/// Points that are tested for shadow. A point is lit unless a triangle is between the point and the light, at a
/// distance above the tolerance (docs/exact_shadows.md). The point belongs to no surface, so no surface has to face the
/// light. A triangle that contains the point, for example around a vertex, is at distance 0 and casts no shadow on it.
/// The near side of a body therefore darkens its far side.
class PointReceivers final : public Receivers {
public:
    /// Creates receivers at `points`, which are in steps of the model's grid (rounded by cellsOf). The triangles of
    /// `cut` cast shadows, except their parts that the planes `sections` (in the same unit) remove. Throws Error if a
    /// point is farther than 2^30 steps from the centre of the cut.
    PointReceivers(
        const exporter::UniformCut& cut, std::vector<glm::i64vec3> points, std::span<const Plane> sections = {});

    std::size_t count() const override { return points_.size(); }

    exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) override;

    /// Computes the same result as `resolve` with simple integer loops, as ground truth for tests. Only points with a
    /// non-zero entry in `isRequested` are tested. The result of all other points is 0.
    void resolvePlainly(
        const IntegerLight& light, std::span<const std::uint8_t> isRequested, std::span<std::uint8_t> isLit);

private:
    glm::uvec3 originCell() const;
    void addCasters(const exporter::UniformCut& cut);
    void addReceiverOnlyClusters();
    void collect(const IntegerLight& light);

    using Position = std::array<std::uint32_t, 3>;

    std::vector<glm::i64vec3> points_; // relative to origin_
    glm::i64vec3 origin_{0};
    std::vector<Position> positions_; // positions of the cut, followed by the points
    std::vector<hierarchy::Triangle> triangles_;
    std::vector<exact::Caster> casters_; // clusters of the cut, followed by receiver-only clusters with the points
    std::size_t castersOfCut_ = 0;
    exact::ExactShadows exact_;
};

} // namespace gnomon::sun
