// Rows or columns of a map spaced by what one view needs (rectilinear texture warping, Rosen 2012): a monotone,
// piecewise linear function of where they would lie without.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon::shadow {

/// So many equal parts of a map's s or t are each given a density of columns or rows.
inline constexpr int kFittedParts = 64;

/// Rows or columns over t or s, here t, from `low` to `high`, evenly within each part of that. Beyond both ends they go
/// on as at the ends.
class FittedAxis {
public:
    using Densities = std::array<double, kFittedParts>;

    FittedAxis();

    /// `densities`, above 0, in proportion; 0 <= low < high <= 1.
    FittedAxis(double low, double high, const Densities& densities);

    double low() const { return low_; }

    double high() const { return high_; }

    /// Where `t` lies among the rows: 0 at low, 1 at high, strictly increasing.
    double at(double t) const;

    /// The inverse of `at`.
    double inverse(double row) const;

    /// The derivative of `at`: how many rows lie there for each of even ones over t from 0 to 1.
    double density(double t) const { return ofPart(part(t)); }

    /// The same of a part, and its `at` where it begins; that of kFittedParts is 1.
    double ofPart(std::size_t part) const { return densities_[part] / (high_ - low_); }

    double start(std::size_t part) const { return starts_[part]; }

    double leastDensity() const;
    double greatestDensity() const;

    /// The same over all of t: what was from low to high is from 0 to 1.
    FittedAxis overAll() const { return {0, 1, densities_}; }

    bool operator==(const FittedAxis&) const = default;

private:
    std::size_t part(double t) const;

    double low_ = 0;
    double high_ = 1;
    Densities densities_{}; // of mean 1
    std::array<double, kFittedParts + 1> starts_{};
};

/// Where the texels of a map lie: columns over its s, rows over its t.
struct FittedGrid {
    FittedAxis columns;
    FittedAxis rows;

    bool operator==(const FittedGrid&) const = default;
};

} // namespace gnomon::shadow
