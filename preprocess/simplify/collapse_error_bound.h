// Upper bounds of the errors of the triangles around a collapse, computed before the collapse is applied.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/collapse_star.h"

namespace gnomon::simplify {

/// The error bounds of a patch's triangles during its simplification, in grid steps. The list is empty if the patch
/// does not need bounds. Each triangle stores the error of the source points that are mapped to it. These are its own
/// points and the points of removed triangles that it received.
class CollapseErrorBound {
public:
    /// The errors of a triangle after the collapse. A receiver of a removed triangle has the errors of the received
    /// points.
    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    CollapseErrorBound(const Patch& patch, SimplificationMesh& mesh);

    /// Bounds the errors after the collapse of `star` for each remaining triangle and each receiver of a removed
    /// triangle. May reorder the faces of the star. Returns false if a removed triangle has no receiver, or if a bound
    /// reaches `limit`.
    bool evaluate(CollapseStar& star, double limit);

    /// Returns the max bound of the last `evaluate`.
    double worst() const { return worst_; }

    /// Returns the bounds of the last `evaluate`.
    std::span<const Outcome> outcomes() const { return outcomes_; }

    /// Stores the outcomes of the last `evaluate`, which must have been for `star`.
    void commit(const CollapseStar& star);

    /// Adds the error of the removed triangle of a duplicate pair to the kept triangle.
    void merge(const SimplificationMesh::Duplicate& pair);

    /// Returns the max error of the triangles around `p`, or 0 if the patch does not need bounds.
    double largestAround(std::uint32_t p);

    /// Returns the errors of a triangle, rounded up.
    TriangleError of(std::uint32_t triangle) const {
        return {roundedUp(error_[triangle].fromSource), roundedUp(error_[triangle].toSource)};
    }

private:
    struct BothErrors { // see TriangleError
        double fromSource = 0;
        double toSource = 0;
    };

    struct Receiver {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = hierarchy::kNone;
    };

    struct Candidate {
        std::uint32_t triangle = hierarchy::kNone;
        Triangle corners{}; // positions after the collapse
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
    std::array<Candidate, proximity::TriangleBatch::kCapacity> candidates_; // candidates for the receiver
    proximity::TriangleBatch batch_; // the same triangles for the distance computation
    Fan fan_;
    std::vector<Outcome> outcomes_;
    double worst_ = 0;
};

} // namespace gnomon::simplify
