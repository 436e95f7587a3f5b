// Upper bounds for the errors of the triangles around a collapse. They are computed before the collapse is applied.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/collapse_star.h"

namespace gnomon::simplify {

/// The error bounds of a patch's triangles during its simplification, in grid steps. The list is empty if the patch
/// does not need bounds. Each source point is mapped to one triangle. A triangle stores the max error of its own source
/// points and of the points that it received from removed triangles.
class CollapseErrorBound {
public:
    /// The errors of a triangle after the collapse. If the triangle receives the points of a removed triangle, these
    /// are the errors of the received points.
    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    CollapseErrorBound(const Patch& patch, SimplificationMesh& mesh);

    /// Computes the errors after the collapse of `star`, for each remaining triangle and each receiver of a removed
    /// triangle. May reorder the faces of the star. Returns false if a removed triangle has no receiver, or if an error
    /// reaches `limit`.
    bool evaluate(CollapseStar& star, double limit);

    /// Returns the max error of the last `evaluate`.
    double worst() const { return worst_; }

    /// Returns the errors of the last `evaluate`.
    std::span<const Outcome> outcomes() const { return outcomes_; }

    /// Stores the errors of the last `evaluate`. This call must have been for `star`.
    void commit(const CollapseStar& star);

    /// Combines the errors of two triangles with the same positions: the kept triangle receives the error of the
    /// removed one.
    void merge(const SimplificationMesh::Duplicate& pair);

    /// Returns the max error of the triangles around position `p`, or 0 if the patch does not need bounds.
    double largestAround(std::uint32_t p);

    /// Returns the errors of a triangle, rounded up.
    TriangleError of(std::uint32_t triangle) const {
        return {roundedUp(error_[triangle].fromSource), roundedUp(error_[triangle].toSource)};
    }

private:
    struct BothErrors { // TriangleError explains the two errors
        double fromSource = 0;
        double toSource = 0;
    };

    struct Receiver {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = hierarchy::kNone;
    };

    struct Candidate {
        std::uint32_t triangle = hierarchy::kNone;
        Triangle corners{}; // positions of its corners after the collapse
    };

    void add(std::uint32_t triangle, double fromSource, double toSource);
    void compareCandidates(const Triangle& t, Receiver& receiver);
    Receiver receiverOf(const Triangle& t, std::uint32_t from, std::uint32_t to);
    bool evaluateFan(CollapseStar& star);

    const Patch& patch_;
    SimplificationMesh& mesh_;
    std::vector<BothErrors> error_; // per triangle
    std::vector<std::uint32_t> stamp_;
    std::uint32_t stampNow_ = 0;
    // triangles that may receive a removed triangle
    std::array<Candidate, proximity::TriangleBatch::kCapacity> candidates_;
    proximity::TriangleBatch batch_; // the same triangles, prepared for distances to several triangles at once
    Fan fan_;
    std::vector<Outcome> outcomes_;
    double worst_ = 0;
};

} // namespace gnomon::simplify
