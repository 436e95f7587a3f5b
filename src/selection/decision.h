// What the error rule decides for certain: yes, no, or undecided where rounding may have decided it.
#pragma once

#include "selection/error_rule.h"
#include "selection/range.h"

#include <array>
#include <cstdint>

namespace gnomon::selection {

enum class Decision : std::uint8_t { No, Yes, Undecided };

/// An error rule in interval arithmetic: the bounds of all that rounding can have done to it, in any rounding mode and
/// in any mixture of them (Higham 2002, section 2; Moore 1966), from the view and its casters on, which are taken as
/// exact. Several times slower than the rule.
class CertainRule {
public:
    /// `rule` must outlive this.
    explicit CertainRule(const ErrorRule& rule);

    /// Pixels between which lie those of exact arithmetic and whatever ErrorRule::pixels returns, however it rounds.
    Range pixels(const Sphere& bounds, double error) const;

    /// Whether refining gains more than `threshold`; where ErrorRule::exceeds may say either, `Undecided`.
    Decision exceeds(const Sphere& bounds, double error, double threshold) const;

private:
    struct PlaneRange {
        std::array<Range, 3> normal;
        Range offset;
    };

    Range viewPixels(const Sphere& bounds, double error) const;
    Range casterPixels(const CasterDetail& caster, const Sphere& bounds, double error) const;
    Range leastReceiverDepth(const CasterDetail& caster, const Sphere& bounds, Decision& meets) const;

    const ErrorRule* rule_;
    std::vector<PlaneRange> pyramid_;
    Range pixelsPerUnit_;
    Range edgePixelsPerUnit_;
    Range cornerCosine_;
};

} // namespace gnomon::selection
