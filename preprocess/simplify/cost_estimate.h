// Estimates the cost of a half-edge collapse. The estimate is computed before the more expensive error bound. It
// contains the quadric error of the target, the edge length, and the change of attributes along the edge.
#pragma once

#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/cost_kernel.h"
#include "preprocess/simplify/simplification_mesh.h"

namespace gnomon::simplify {

/// Estimates the costs of collapses as squared distances in grid steps. At open edges and attribute seams (edges
/// between different normals or colours) the quadrics also contain planes perpendicular to the faces (Garland, Heckbert
/// 1997).
class CostEstimate {
public:
    /// Prepares the estimates for `patch`. `mesh` must still be unchanged, without any collapse.
    CostEstimate(const Patch& patch, const SimplificationMesh& mesh);

    /// Returns the estimated cost of a collapse of position `from` onto position `to`, as a squared distance.
    double square(std::uint32_t from, std::uint32_t to) const {
        const double length = proximity::squaredLength(patch_.positions[from] - patch_.positions[to]);
        // Faces without area have no planes, so the cost depends only on the edge length.
        if (!(quadric_[from].weight > 0)) return length * 0.01;
        return planes(from, to) + length * (weights_.length + attributes(from, to));
    }

    /// Returns `square(from, target)` for each target in `to`. The result is valid until the next call.
    std::span<const double> squares(std::uint32_t from, std::span<const std::uint32_t> to);

    /// Returns the mean squared distance of position `to` from the planes in the quadric of position `from`.
    double planes(std::uint32_t from, std::uint32_t to) const {
        return quadric_[from].meanSquare(patch_.positions[to]);
    }

    /// Adds the quadric of position `from` to the quadric of position `to`, after `from` has collapsed onto `to`.
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
    std::vector<CostSite> sites_; // per position: its coordinates and attributes
    EdgeWeights weights_;
    std::vector<double> squares_;
};

} // namespace gnomon::simplify
