// The estimated cost of a half-edge collapse, computed before its error bound. The estimate contains the quadric error
// of the target, the edge length, and the change of attributes along the edge.
#pragma once

#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/cost_kernel.h"
#include "preprocess/simplify/simplification_mesh.h"

namespace gnomon::simplify {

/// Estimates the costs of collapses as squared distances in grid steps. Open edges and attribute seams (different
/// normals or colours) add planes perpendicular to their faces (Garland, Heckbert 1997).
class CostEstimate {
public:
    /// Prepares the estimates of `patch`. No collapse may have been applied to `mesh` yet.
    CostEstimate(const Patch& patch, const SimplificationMesh& mesh);

    /// Returns the estimate for a collapse of `from` onto `to`.
    double square(std::uint32_t from, std::uint32_t to) const {
        const double length = proximity::squaredLength(patch_.positions[from] - patch_.positions[to]);
        // Without any area there are no planes to measure distances from.
        if (!(quadric_[from].weight > 0)) return length * 0.01;
        return planes(from, to) + length * (weights_.length + attributes(from, to));
    }

    /// Returns `square` for each target of `to`. The result is valid until the next call.
    std::span<const double> squares(std::uint32_t from, std::span<const std::uint32_t> to);

    /// Returns the mean squared distance of `to` from the planes of `from`.
    double planes(std::uint32_t from, std::uint32_t to) const {
        return quadric_[from].meanSquare(patch_.positions[to]);
    }

    /// Adds the quadric of `from` to the quadric of `to`.
    void merge(std::uint32_t from, std::uint32_t to) { quadric_[to].add(quadric_[from]); }

private:
    double attributes(std::uint32_t from, std::uint32_t to) const {
        double cost = 0;
        const CostSite& a = sites_[from];
        const CostSite& b = sites_[to];
        if (weights_.normal > 0 && a.hasNormal() && b.hasNormal())
            cost += weights_.normal * proximity::squaredLength(vectorOf(a.normal) - vectorOf(b.normal));
        if (weights_.color > 0)
            cost += weights_.color * proximity::squaredLength(vectorOf(a.color) - vectorOf(b.color));
        return cost;
    }

    void addFacePlanes(const SimplificationMesh& mesh);
    void addEdgePlanes(const SimplificationMesh& mesh);
    void loadSites();

    const Patch& patch_;
    std::vector<Quadric> quadric_;
    std::vector<CostSite> sites_; // per position
    EdgeWeights weights_;
    std::vector<double> squares_;
};

} // namespace gnomon::simplify
