// Maps fitted to the samples of one view: what these need of each map, and where its rows and columns then lie.
#pragma once

#include "shadow/warp/warped_map.h"

#include <span>
#include <vector>

namespace gnomon::shadow {

/// The densest part of an axis over the mean, and the sparsest: what a lookup in single precision resolves, the
/// rasteriser has room for, and texels are wasted on parts that nothing is seen in.
inline constexpr double kMostRowDensity = 8;
inline constexpr double kMostColumnDensity = 4;
inline constexpr double kLeastDensity = 1.0 / 16;

/// Of columns so many parts differ: each is drawn by itself. They lie evenly unless that lowers what is needed of them
/// by this factor.
inline constexpr int kColumnParts = 16;
inline constexpr double kWorthColumns = 1.05;

/// Rows and columns are made so dense that no sample has more than this over the least that could be promised for the
/// view; what is left goes where it lowers the mean over the samples most.
inline constexpr double kPromiseSlack = 4.0 / 3;

/// A fit of the frame before is kept until a new one would lower what it promises, or its mean, by this factor.
inline constexpr double kRefit = 1.25;

/// A new one stays ready for what was seen of late where that raises what it promises by no more than this factor.
inline constexpr double kRemembering = 1.12;

/// What was needed in equal cells of s or of t, from 0 to 1, less by a tenth with each new fit since.
using NeedsOfLate = std::array<float, kFittedParts>;

/// Rows and columns of one map, over its map without a fit.
struct MapFit {
    FittedAxis columns;
    FittedAxis rows;
    Aliasing unit; // what texels are shared out by: the most along s and, sheared, along t, at unit resolutions
    NeedsOfLate columnsOfLate{};
    NeedsOfLate rowsOfLate{};

    bool operator==(const MapFit& other) const {
        return columns == other.columns && rows == other.rows && unit.x == other.unit.x && unit.z == other.unit.z &&
               columnsOfLate == other.columnsOfLate && rowsOfLate == other.rowsOfLate;
    }
};

/// What samples need along one axis of a map, in equal bins of s or t, at the even resolution 1.
class AxisNeeds {
public:
    /// `need` 0 asks for nothing but to be covered.
    void add(double at, double need);

    /// Adds what was added to `other`.
    void add(const AxisNeeds& other);

    /// Whether all that was added lies in what `axis` covers.
    bool areWithin(const FittedAxis& axis) const;

    /// The largest need under `axis`, and the sum of all; a texel may reach into the bins beside it.
    struct Found {
        double most = 0;
        double sum = 0;
    };

    Found under(const FittedAxis& axis) const;

    NeedsOfLate ofLate(const NeedsOfLate* before) const;

    /// How an axis may be spaced.
    struct Limits {
        int steps = 8; // that its ends are rounded to: parts of the map
        int slack = 4; // bins on each side of a sample that are as dense as it asks
        int parts = kFittedParts;
        double mostDensity = kMostRowDensity;
        double promiseSlack = kPromiseSlack;
    };

    /// The axis of the least need, but for kPromiseSlack and no more than `bound`; for `before` as well, what was
    /// needed of late.
    FittedAxis fit(const Limits& limits, double bound, const NeedsOfLate* before) const;

private:
    static constexpr int kBins = 1024;

    struct Bin {
        double need = 0; // largest
        double sum = 0;
        bool isUsed = false;
    };

    /// The largest need within `slack` bins of each, and of its cell of late.
    std::vector<double> widened(int slack, const NeedsOfLate* before) const;

    std::vector<Bin> bins_ = std::vector<Bin>(kBins);
};

/// What the samples of a view need of one map, by where they lie in s and t.
class SampleNeeds {
public:
    /// Of the unfitted map `base` of a slice.
    SampleNeeds(const WarpedMap& base, const ViewFrustum& slice);

    /// Adds what lies at `p` in camera space. Outside the slice's depths nothing is promised, but the map covers it.
    void add(const glm::dvec3& p);

    /// Adds the samples of `other`, which is of the same map.
    void add(const SampleNeeds& other);

    bool isEmpty() const { return count_ == 0; }

    /// The fit of the least promise, but for kPromiseSlack; `bound`, which the map promises for its whole region, is
    /// not exceeded either: m_s and sheared m_t at unit resolutions. With the fit of the frame before it stays as
    /// ready as that for what was seen of late.
    MapFit fit(const Aliasing& bound, const MapFit* before = nullptr) const;

    /// Whether all samples lie in what `fit` covers.
    bool areWithin(const MapFit& fit) const;

    /// What the samples have under `fit`, at unit resolutions: the largest of each measure, and the sums.
    struct Found {
        AxisNeeds::Found x;
        AxisNeeds::Found sheared;
        double z = 0; // without the shear
    };

    Found under(const MapFit& fit) const;

private:
    WarpedMap base_;
    double near_;
    double far_;
    double pixelSlope_; // of an image of one pixel
    double rowLength_;
    double lean_;
    double perGrowth_; // 1 / ln of what w grows by; 0 of even rows
    AxisNeeds alongS_;
    AxisNeeds alongT_;
    AxisNeeds unsheared_; // along t
    std::size_t count_ = 0;
};

/// `map` with the rows and columns of `fit`.
WarpedMap fitted(WarpedMap map, const MapFit& fit);

/// One fit for each of `needs`; `bounds` as SampleNeeds::fit has them. Those of `before`, the frame before's, are kept
/// all together as long as they cover the samples, kRefit allows, and they promise no more than the maps without a fit.
std::vector<MapFit> fitsOf(
    std::span<const SampleNeeds> needs, std::span<const Aliasing> bounds, std::span<const MapFit> before);

} // namespace gnomon::shadow
