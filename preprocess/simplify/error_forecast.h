// What a collapse does to the errors of the triangles around it: bounds, known before it is carried out.
#pragma once

#include "preprocess/proximity/nearest_kernel.h"
#include "preprocess/simplify/collapse_star.h"

namespace gnomon::simplify {

/// Keeps the errors of a patch's triangles while it is simplified, in grid steps; nothing where they are not asked for.
class ErrorForecast {
public:
    /// What a triangle answers for besides its own source points, once it has taken those of another.
    struct Outcome {
        std::uint32_t triangle;
        double fromSource;
        double toSource;
    };

    ErrorForecast(const Patch& patch, LivingPatch& living);

    /// Bounds what the collapse of `star` does to each triangle that stays, or takes what another leaves, and may put
    /// the star's faces in another order; false if nobody can, or if one of the bounds reaches `limit`.
    bool foresee(CollapseStar& star, double limit);

    /// The largest bound of what was foreseen last.
    double worst() const { return worst_; }

    /// Of what was foreseen last.
    std::span<const Outcome> outcomes() const { return outcomes_; }

    /// The errors of the triangles that stay in `star` become those that were foreseen for it.
    void take(const CollapseStar& star);

    /// One of two triangles with the same positions answers for both.
    void join(const LivingPatch::Doubled& pair);

    /// The largest error of the triangles around `p`; 0 where errors are not asked for.
    double around(std::uint32_t p);

    /// The error of a triangle, rounded up.
    TriangleError of(std::uint32_t triangle) const {
        return {roundedUp(error_[triangle].fromSource), roundedUp(error_[triangle].toSource)};
    }

private:
    struct BothErrors { // as in TriangleError
        double fromSource = 0;
        double toSource = 0;
    };

    struct Heir {
        double square = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = hierarchy::kNone;
    };

    struct Candidate {
        std::uint32_t triangle = hierarchy::kNone;
        Triangle corners{}; // as they are after the collapse
    };

    void add(std::uint32_t triangle, double fromSource, double toSource);
    void weigh(const Triangle& t, Heir& heir);
    Heir heirOf(const Triangle& t, std::uint32_t from, std::uint32_t to);
    bool foreseeFan(CollapseStar& star);

    const Patch& patch_;
    LivingPatch& living_;
    std::vector<BothErrors> error_; // per triangle
    std::vector<std::uint32_t> stamp_;
    std::uint32_t stampNow_ = 0;
    std::array<Candidate, proximity::TriangleRows::kMost> candidates_; // for an heir
    proximity::TriangleRows rows_;                                     // of them
    Fan fan_;
    std::vector<Outcome> outcomes_;
    double worst_ = 0;
};

} // namespace gnomon::simplify
