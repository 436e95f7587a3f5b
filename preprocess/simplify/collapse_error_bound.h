// Upper bounds of the errors that a collapse leaves to the triangles around it, evaluated before it is carried out.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/collapse_star.h"

namespace gnomon::simplify {

/// The error bounds of a patch's triangles while it is simplified, in grid steps; none if the patch does not ask for
/// them. Each triangle carries the error of the source points that were mapped to it: those of its own and those of the
/// vanished triangles that it received.
class CollapseErrorBound {
public:
    /// The errors of a triangle after the collapse; for the receiver of a vanishing triangle those of what it receives.
    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    CollapseErrorBound(const Patch& patch, SimplificationMesh& mesh);

    /// Bounds the errors after the collapse of `star` of each triangle that stays or receives the source points of one
    /// that vanishes; may reorder the star's faces. False if a vanishing triangle has no receiver, or once a bound
    /// reaches `limit`.
    bool evaluate(CollapseStar& star, double limit);

    /// The largest bound of the last `evaluate`.
    double worst() const { return worst_; }

    /// The bounds of the last `evaluate`.
    std::span<const Outcome> outcomes() const { return outcomes_; }

    /// Stores the outcomes of the last `evaluate`, which was of `star`.
    void commit(const CollapseStar& star);

    /// Of two triangles with the same positions the kept one carries the error of both.
    void merge(const SimplificationMesh::Duplicate& pair);

    /// The largest error of the triangles around `p`; 0 where errors are not asked for.
    double largestAround(std::uint32_t p);

    /// The error of a triangle, rounded up.
    TriangleError of(std::uint32_t triangle) const {
        return {roundedUp(error_[triangle].fromSource), roundedUp(error_[triangle].toSource)};
    }

private:
    struct BothErrors { // as in TriangleError
        double fromSource = 0;
        double toSource = 0;
    };

    struct Receiver {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = hierarchy::kNone;
    };

    struct Candidate {
        std::uint32_t triangle = hierarchy::kNone;
        Triangle corners{}; // as they are after the collapse
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
    std::array<Candidate, proximity::TriangleBatch::kCapacity> candidates_; // for the receiver
    proximity::TriangleBatch batch_;                                        // of them
    Fan fan_;
    std::vector<Outcome> outcomes_;
    double worst_ = 0;
};

} // namespace gnomon::simplify
