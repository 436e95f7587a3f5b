// What moving one position onto another costs before the errors are known: the quadric of its planes, and the length
// and the attributes of the edge.
#pragma once

#include "preprocess/build/living_patch.h"
#include "preprocess/build/quadric.h"
#include "preprocess/build/triangle_distance.h"

namespace gnomon::preprocess {

/// Costs are squared distances in grid steps. Open edges, and edges along which normals or colours part, have planes of
/// their own, upright on their faces.
class CostEstimate {
public:
    /// Of `patch`, with nothing collapsed yet in `living`.
    CostEstimate(const Patch& patch, const LivingPatch& living);

    /// The estimate for moving `from` onto `to`.
    double square(std::uint32_t from, std::uint32_t to) const {
        const double length = squaredLength(patch_.positions[from] - patch_.positions[to]);
        // Without any area there are no planes to tell how far is far.
        if (!(quadric_[from].weight > 0)) return length * 0.01;
        return planes(from, to) + length * (kLengthWeight + attributes(from, to));
    }

    /// The part of it that is a distance: the mean square of those of `to` from the planes of `from`.
    double planes(std::uint32_t from, std::uint32_t to) const {
        return quadric_[from].meanSquare(patch_.positions[to]);
    }

    /// Gives the planes of `from` to `to`.
    void join(std::uint32_t from, std::uint32_t to) { quadric_[to].add(quadric_[from]); }

private:
    static constexpr double kLengthWeight = 1e-5; // of the squared length: in flat places short edges go first
    static constexpr double kNormalWeight = 0.1;  // of the squared length times the squared change of the normal
    static constexpr double kColorWeight = 0.02;  // the same for colours, whose channels are in 0..1

    double attributes(std::uint32_t from, std::uint32_t to) const {
        double cost = 0;
        if (!normal_.empty() && squaredLength(normal_[from]) > 0 && squaredLength(normal_[to]) > 0)
            cost += kNormalWeight * squaredLength(normal_[from] - normal_[to]);
        if (!color_.empty()) cost += kColorWeight * squaredLength(color_[from] - color_[to]);
        return cost;
    }

    void addFacePlanes(const LivingPatch& living);
    void addEdgePlanes(const LivingPatch& living);
    void loadAttributes();

    const Patch& patch_;
    std::vector<Quadric> quadric_;
    std::vector<glm::dvec3> normal_; // per position, zero for none; empty if the patch has none
    std::vector<glm::dvec3> color_;  // per position; empty if all are alike
};

} // namespace gnomon::preprocess
