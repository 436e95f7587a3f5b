// Rows of a map spaced by what one view needs (rectilinear texture warping, Rosen 2012): a monotone, piecewise linear
// function of where they would lie without.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon::shadow {

/// So many equal parts of a map's t are each given a density of rows.
inline constexpr int kFittedParts = 64;

/// The densest part over the mean, and the sparsest: what a lookup in single precision resolves, and what rows are
/// wasted on parts that nothing is seen in.
inline constexpr double kMostDensity = 8;
inline constexpr double kLeastDensity = 1.0 / 16;

/// Rows over t from `low` to `high`, evenly within each part of that. Beyond both ends they go on as at the ends.
class FittedRows {
public:
    using Densities = std::array<double, kFittedParts>;

    FittedRows();

    /// `densities`, above 0, in proportion; 0 <= low < high <= 1.
    FittedRows(double low, double high, const Densities& densities);

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

    bool operator==(const FittedRows&) const = default;

private:
    std::size_t part(double t) const;

    double low_ = 0;
    double high_ = 1;
    Densities densities_{}; // of mean 1
    std::array<double, kFittedParts + 1> starts_{};
};

} // namespace gnomon::shadow
