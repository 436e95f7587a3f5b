// Computes upper bounds for the errors of the triangles around an edge collapse, before the collapse is applied.
#pragma once

#include "preprocess/proximity/triangle_batch.h"
#include "preprocess/simplify/collapse_star.h"

namespace gnomon::simplify {

/// The upper bounds of the simplification error of each triangle of a patch, in grid steps. Each point of the source
/// mesh is mapped to one triangle. The error of a triangle is the max over its own source points and the points that it
/// received from removed triangles. There are no bounds if the patch does not need them.
class CollapseErrorBound {
public:
    /// The errors of one triangle after a collapse. For a triangle that receives the source points of a removed
    /// triangle, these are the errors of the received points.
    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    CollapseErrorBound(const Patch& patch, SimplificationMesh& mesh);

    /// Computes the errors after the collapse of `star`. It computes them for each remaining triangle, and for each
    /// triangle that receives the source points of a removed triangle. May reorder the faces of the star. Returns false
    /// if no triangle can receive the points of a removed triangle, or if an error reaches `limit`.
    bool evaluate(CollapseStar& star, double limit);

    /// Returns the max error that the last call of `evaluate` computed.
    double worst() const { return worst_; }

    /// Returns the triangle errors that the last call of `evaluate` computed.
    std::span<const Outcome> outcomes() const { return outcomes_; }

    /// Stores the errors that the last call of `evaluate` computed. That call must have been for `star`.
    void commit(const CollapseStar& star);

    /// Combines the errors of two triangles with the same corner positions. The kept triangle receives the error of the
    /// removed triangle.
    void merge(const SimplificationMesh::Duplicate& pair);

    /// Returns the max error of the triangles around position `p`. Returns 0 if the patch does not need error bounds.
    double largestAround(std::uint32_t p);

    /// Returns the error bounds of a triangle, rounded up to floats.
    TriangleError of(std::uint32_t triangle) const {
        return {roundedUp(error_[triangle].fromSource), roundedUp(error_[triangle].toSource)};
    }

private:
    struct BothErrors { // the two errors of a triangle, as in TriangleError
        double fromSource = 0;
        double toSource = 0;
    };

    struct Receiver {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = hierarchy::kNone;
    };

    struct Candidate {
        std::uint32_t triangle = hierarchy::kNone;
        Triangle corners{}; // corner positions after the collapse
    };

    void add(std::uint32_t triangle, double fromSource, double toSource);
    void compareCandidates(const Triangle& t, Receiver& receiver);
    Receiver receiverOf(const Triangle& t, std::uint32_t from, std::uint32_t to);
    bool evaluateFan(CollapseStar& star);

    const Patch& patch_;
    SimplificationMesh& mesh_;
    std::vector<BothErrors> error_; // errors of each triangle
    std::vector<std::uint32_t> stamp_;
    std::uint32_t stampNow_ = 0;
    // triangles that may receive the source points of a removed triangle
    std::array<Candidate, proximity::TriangleBatch::kCapacity> candidates_;
    proximity::TriangleBatch batch_; // the triangles of `candidates_`, prepared for SIMD distances
    Fan fan_;
    std::vector<Outcome> outcomes_;
    double worst_ = 0;
};

} // namespace gnomon::simplify
