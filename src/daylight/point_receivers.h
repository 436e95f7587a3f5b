// Points anywhere in a model as receivers, before one uniform cut of it.
#pragma once

#include "core/convex_volume.h"
#include "daylight/receivers.h"
#include "hierarchy/grid.h"
#include "preprocess/exporter/export.h"

#include <vector>

namespace gnomon::daylight {

/// A point is lit unless a triangle of the cut stands ahead of it, farther than the tolerance (docs/exact_shadows.md):
/// it belongs to no surface, so nothing has to face the light. A triangle that holds the point, as do those around a
/// vertex, meets the ray at distance 0 and casts nothing on it: what darkens the far side of a body is the body's
/// nearer side.
class PointReceivers final : public Receivers {
public:
    /// Points in cells of the model's grid, as cellsOf rounds them; of `cut` casts what lies on the inner side of all
    /// `sections`, which are in cells too. Throws Error if a point is farther than 2^30 cells from the middle of the
    /// cut.
    PointReceivers(
        const exporter::UniformCut& cut, std::vector<glm::i64vec3> points, std::span<const Plane> sections = {});

    std::size_t count() const override { return points_.size(); }

    exact::ExactStatistics decide(const IntegerLight& light, std::span<std::uint8_t> isLit) override;

    /// The same by the plain integer loops, of those that `isAsked` has no 0 for; 0 of the others. To be checked by.
    void decidePlainly(const IntegerLight& light, std::span<const std::uint8_t> isAsked, std::span<std::uint8_t> isLit);

private:
    glm::uvec3 originCell() const;
    void addCasters(const exporter::UniformCut& cut);
    void addHolders();
    void collect(const IntegerLight& light);

    using Position = std::array<std::uint32_t, 3>;

    std::vector<glm::i64vec3> points_; // from the origin
    glm::i64vec3 origin_{0};
    std::vector<Position> positions_; // the cut's, and then the points'
    std::vector<hierarchy::Triangle> triangles_;
    std::vector<exact::Caster> casters_; // those of the cut; then those that hold the points
    std::size_t castersOfCut_ = 0;
    exact::ExactShadows exact_;
};

} // namespace gnomon::daylight
