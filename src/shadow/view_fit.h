// Maps fitted to the samples of one view: what these need of each map, and where its rows and columns then lie.
#pragma once

#include "shadow/warp/warped_map.h"

#include <span>
#include <vector>

namespace gnomon::shadow {

/// Rows are made so dense that no sample has more than this over the least that could be promised for the view; what
/// is left goes where it lowers the mean over the samples most.
inline constexpr double kPromiseSlack = 4.0 / 3;

/// A fit of the frame before is kept until a new one would lower what it promises, or its mean, by this factor.
inline constexpr double kRefit = 1.25;

/// A new one stays ready for what was seen of late where that raises what it promises by no more than this factor.
inline constexpr double kRemembering = 1.12;

/// What was needed in equal cells of t, from 0 to 1, less by a tenth with each new fit since.
using NeedsOfLate = std::array<float, kFittedParts>;

/// Rows and columns of one map, over its map without a fit: s from sLow to sHigh, and rows.
struct MapFit {
    double sLow = 0;
    double sHigh = 1;
    FittedRows rows;
    Aliasing unit; // what texels are shared out by: the most along s and, sheared, along t, at unit resolutions
    NeedsOfLate ofLate{};

    bool operator==(const MapFit& other) const {
        return sLow == other.sLow && sHigh == other.sHigh && rows == other.rows && unit.x == other.unit.x &&
               unit.z == other.unit.z && ofLate == other.ofLate;
    }
};

/// What the samples of a view need of one map, by where they lie in t.
class SampleNeeds {
public:
    /// Of the unfitted map `base` of a slice.
    SampleNeeds(const WarpedMap& base, const ViewFrustum& slice);

    /// Adds what lies at `p` in camera space. Outside the slice's depths nothing is promised, but the map covers it.
    void add(const glm::dvec3& p);

    bool isEmpty() const { return count_ == 0; }

    /// The fit of the least promise, but for kPromiseSlack; `bound`, which the map promises for its whole region, is
    /// not exceeded either: the largest sheared m_t at unit resolutions. With the fit of the frame before it stays as
    /// ready as that for what was seen of late.
    MapFit fit(double bound, const MapFit* before = nullptr) const;

    /// Whether all samples lie in what `fit` covers.
    bool areWithin(const MapFit& fit) const;

    /// What the samples have under `fit`, at unit resolutions: the largest of each measure, and the sum along t.
    struct Found {
        double x = 0;
        double z = 0;
        double sheared = 0;
        double sum = 0;
    };

    Found under(const MapFit& fit) const;

private:
    static constexpr int kBins = 1024;

    /// Of the samples of a bin, with even t.
    struct Bin {
        double z = 0; // largest
        double sheared = 0;
        double sum = 0; // of sheared
        bool isUsed = false;
    };

    /// The largest sheared need within a few bins of each, and of its cell of late.
    std::vector<double> widened(const MapFit* before) const;

    NeedsOfLate ofLate(const MapFit* before) const;

    WarpedMap base_;
    double near_;
    double far_;
    double pixelSlope_; // of an image of one pixel
    double rowLength_;
    double lean_;
    double perGrowth_; // 1 / ln of what w grows by; 0 of even rows
    std::vector<Bin> bins_;
    double x_ = 0;
    double sLeast_ = 1;
    double sMost_ = 0;
    std::size_t count_ = 0;
};

/// `map` with the rows and columns of `fit`.
WarpedMap fitted(WarpedMap map, const MapFit& fit);

/// One fit for each of `needs`; `bounds` as SampleNeeds::fit has them. Those of `before`, the frame before's, are kept
/// all together as long as they cover the samples, kRefit allows, and they promise no more than the maps without a fit.
std::vector<MapFit> fitsOf(
    std::span<const SampleNeeds> needs, std::span<const Aliasing> bounds, std::span<const MapFit> before);

} // namespace gnomon::shadow
