#include "shadow/view_fit.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr int kSteps = 8;        // that the ends of t are rounded to: of an eighth of the map each
constexpr int kColumnSteps = 32; // likewise of s
constexpr int kSlack = 4;        // bins on each side of a sample that are as dense as it asks
constexpr float kFading = 0.9F;
constexpr double kColumnSlack = 1.0 / 128;
constexpr double kUnseen = 1.0 / 64; // what a map that no sample asks has of the resolution that its region calls for

/// The largest value up to `high` at which `mean`, which grows, is at most 1.
template <class Function>
double largestWithin(const Function& mean, double high) {
    if (mean(high) <= 1) return high;
    double low = 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (mean(middle) <= 1 ? low : high) = middle;
    }
    return low;
}

double meanOf(const FittedRows::Densities& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / kFittedParts;
}

/// A part of the rows that are to be spaced: the largest need in it and the sum of all.
struct Part {
    double need = 0;
    double sum = 0;
};

using Parts = std::array<Part, kFittedParts>;

/// Densities of mean 1 that keep every need over its density at `promise` or below and lower the mean with what is
/// left: the sum of sum / density is least where densities are as the square roots.
FittedRows::Densities spaced(const Parts& parts, double promise) {
    const auto densities = [&](double scale) {
        FittedRows::Densities result{};
        for (std::size_t i = 0; i < kFittedParts; ++i)
            result[i] = std::min(
                kMostDensity, std::max({kLeastDensity, parts[i].need / promise, scale * std::sqrt(parts[i].sum)}));
        return result;
    };
    double most = 0;
    for (const Part& part : parts)
        most = std::max(most, std::sqrt(part.sum));
    const double high = most > 0 ? 1e6 / most : 1;
    return densities(largestWithin([&](double scale) { return meanOf(densities(scale)); }, high));
}

} // namespace

SampleNeeds::SampleNeeds(const WarpedMap& base, const ViewFrustum& slice)
    : base_(base),
      near_(slice.near * (1 - 1e-6)),
      far_(slice.far * (1 + 1e-6)),
      pixelSlope_(2 * tanHalfY(slice)),
      rowLength_(rowLength(base.kappa, base.length, base.rows)),
      lean_(lean(base.frame)),
      perGrowth_(hasLogRows(base) ? 1 / std::log1p(base.kappa * base.length) : 0),
      bins_(kBins) {}

void SampleNeeds::add(const glm::dvec3& p) {
    ++count_;
    const glm::dvec3 light = toLight(base_.frame, p);
    const double zeta = light.z - base_.zMin;
    const double w = std::max(1 + base_.kappa * zeta, 1e-12);
    const double u = light.x / w;
    const double s = std::clamp((u - base_.uMin) / base_.width, 0.0, 1.0); // rounding apart it is
    sLeast_ = std::min(sLeast_, s);
    sMost_ = std::max(sMost_, s);
    const bool isLog = perGrowth_ > 0;
    const double t = isLog ? std::log(w) * perGrowth_ : zeta * (1 + base_.kappa * base_.length) / (base_.length * w);
    Bin& bin = bins_[static_cast<std::size_t>(std::clamp(t * kBins, 0.0, kBins - 1.0))];
    bin.isUsed = true;
    if (p.z < near_ || p.z > far_) return;
    const double perPixel = 1 / (pixelSlope_ * p.z);
    const double z = rowLength_ * (isLog ? w : w * w) * perPixel;
    const double shear = base_.kappa * u + lean_;
    const double sheared = z * std::sqrt(1 + shear * shear);
    bin.z = std::max(bin.z, z);
    bin.sheared = std::max(bin.sheared, sheared);
    bin.sum += sheared;
    x_ = std::max(x_, base_.width * w * perPixel);
}

NeedsOfLate SampleNeeds::ofLate(const MapFit* before) const {
    NeedsOfLate needs{};
    if (before != nullptr)
        for (std::size_t i = 0; i < kFittedParts; ++i)
            needs[i] = before->ofLate[i] * kFading;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        float& need = needs[i / (kBins / kFittedParts)];
        need = std::max(need, static_cast<float>(bins_[i].sheared));
    }
    return needs;
}

std::vector<double> SampleNeeds::widened(const MapFit* before) const {
    const NeedsOfLate late = ofLate(before);
    std::vector<double> needs(kBins);
    for (int i = 0; i < kBins; ++i) {
        double& need = needs[static_cast<std::size_t>(i)];
        if (before != nullptr) need = double{late[static_cast<std::size_t>(i) / (kBins / kFittedParts)]};
        for (int k = std::max(0, i - kSlack); k <= std::min(kBins - 1, i + kSlack); ++k)
            need = std::max(need, bins_[static_cast<std::size_t>(k)].sheared);
    }
    return needs;
}

MapFit SampleNeeds::fit(double bound, const MapFit* before) const {
    const std::vector<double> needs = widened(before);
    int first = kBins;
    int last = 0;
    for (int i = 0; i < kBins; ++i)
        if (bins_[static_cast<std::size_t>(i)].isUsed || needs[static_cast<std::size_t>(i)] > 0) {
            first = std::min(first, i);
            last = i;
        }
    constexpr int kStep = kBins / kSteps;
    const int low = std::max(0, first - kSlack) / kStep;
    const int high = std::min(kBins - 1, last + kSlack) / kStep + 1;
    Parts parts{};
    const int binsAPart = (high - low) * kStep / kFittedParts;
    for (int i = low * kStep; i < high * kStep; ++i) {
        Part& part = parts[static_cast<std::size_t>((i - low * kStep) / binsAPart)];
        const auto bin = static_cast<std::size_t>(i);
        part.need = std::max(part.need, needs[bin]);
        part.sum += bins_[bin].sum;
    }
    // In the rows of [low, high], of which there are as many as of all.
    const double share = static_cast<double>(high - low) / kSteps;
    double most = 0;
    for (const Part& part : parts)
        most = std::max(most, part.need);
    const auto mean = [&](double perNeed) {
        double sum = 0;
        for (const Part& part : parts)
            sum += std::clamp(part.need * perNeed, kLeastDensity, kMostDensity);
        return sum / kFittedParts;
    };
    MapFit result;
    result.sLow = std::max(0.0, std::floor((sLeast_ - kColumnSlack) * kColumnSteps) / kColumnSteps);
    result.sHigh = std::min(1.0, std::ceil((sMost_ + kColumnSlack) * kColumnSteps) / kColumnSteps);
    result.sHigh = std::max(result.sHigh, result.sLow + 1.0 / kColumnSteps);
    if (before != nullptr) {
        result.sLow = std::min(result.sLow, before->sLow + 1.0 / kColumnSteps);
        result.sHigh = std::max(result.sHigh, before->sHigh - 1.0 / kColumnSteps);
    }
    result.ofLate = ofLate(before);
    if (!(most > 0)) return result;
    const double perNeed = largestWithin(mean, kMostDensity / most);
    const double promise = std::max(1 / perNeed, std::min(bound / share, kPromiseSlack / perNeed));
    result.rows =
        FittedRows(static_cast<double>(low) / kSteps, static_cast<double>(high) / kSteps, spaced(parts, promise));
    const Found found = under(result);
    result.unit = {found.x, found.sheared};
    return result;
}

bool SampleNeeds::areWithin(const MapFit& fit) const {
    if (isEmpty()) return true;
    if (sLeast_ < fit.sLow || sMost_ > fit.sHigh) return false;
    for (int i = 0; i < kBins; ++i) {
        const bool isInside = i >= fit.rows.low() * kBins && i < fit.rows.high() * kBins;
        if (bins_[static_cast<std::size_t>(i)].isUsed && !isInside) return false;
    }
    return true;
}

SampleNeeds::Found SampleNeeds::under(const MapFit& fit) const {
    constexpr double kRounding = 1 + 1e-4; // what maps in single precision lose
    Found found;
    found.x = x_ * (fit.sHigh - fit.sLow) * kRounding;
    // A texel of a sample may reach into the bins beside it.
    for (int i = 0; i < kBins; ++i) {
        const Bin& bin = bins_[static_cast<std::size_t>(i)];
        if (!(bin.sheared > 0)) continue;
        const auto density = [&](int k) { return fit.rows.density((k + 0.5) / kBins); };
        const double least =
            std::min({density(std::max(i - 1, 0)), density(i), density(std::min(i + 1, kBins - 1))}) / kRounding;
        found.z = std::max(found.z, bin.z / least);
        found.sheared = std::max(found.sheared, bin.sheared / least);
        found.sum += bin.sum / density(i);
    }
    return found;
}

WarpedMap fitted(WarpedMap map, const MapFit& fit) {
    map.uMin += fit.sLow * map.width;
    map.width *= fit.sHigh - fit.sLow;
    map.fitted = std::make_shared<const FittedRows>(fit.rows);
    return map;
}

namespace {

/// What a budget of texels comes to under `fits`, whose units share it out: the largest error and the mean one, both up
/// to the same factor.
struct Outcome {
    double worst = 0;
    double mean = 0;
};

Outcome outcomeOf(std::span<const SampleNeeds> needs, std::span<const MapFit> fits) {
    double storage = 0;
    double excess = 0;
    double sum = 0;
    for (std::size_t i = 0; i < fits.size(); ++i) {
        const Aliasing& unit = fits[i].unit;
        storage += unit.x * unit.z;
        const SampleNeeds::Found found = needs[i].under(fits[i]);
        excess = std::max({excess, found.x / unit.x, found.sheared / unit.z});
        sum += found.sum / unit.z;
    }
    return {std::sqrt(storage) * excess, std::sqrt(storage) * sum};
}

/// What logarithmic rows promise of the same budget.
double unfittedWorst(std::span<const Aliasing> bounds) {
    double storage = 0;
    for (const Aliasing& bound : bounds)
        storage += bound.x * bound.z;
    return std::sqrt(storage);
}

bool areWithin(std::span<const SampleNeeds> needs, std::span<const MapFit> fits) {
    for (std::size_t i = 0; i < needs.size(); ++i)
        if (!needs[i].areWithin(fits[i])) return false;
    return true;
}

std::vector<MapFit> newFits(
    std::span<const SampleNeeds> needs, std::span<const Aliasing> bounds, std::span<const MapFit> before) {
    std::vector<MapFit> fits;
    for (std::size_t i = 0; i < needs.size(); ++i) {
        MapFit fit = needs[i].isEmpty() ? MapFit{} : needs[i].fit(bounds[i].z, before.empty() ? nullptr : &before[i]);
        if (!(fit.unit.z > 0)) fit.unit = {bounds[i].x * kUnseen, bounds[i].z * kUnseen};
        fits.push_back(fit);
    }
    return fits;
}

/// Maps as they are without a fit, which nothing that comes into view makes promise more; they remember what `fresh`
/// do.
std::vector<MapFit> withoutFits(std::span<const Aliasing> bounds, std::span<const MapFit> fresh) {
    std::vector<MapFit> fits(fresh.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        fits[i].unit = bounds[i];
        fits[i].ofLate = fresh[i].ofLate;
    }
    return fits;
}

} // namespace

std::vector<MapFit> fitsOf(
    std::span<const SampleNeeds> needs, std::span<const Aliasing> bounds, std::span<const MapFit> before) {
    std::vector<MapFit> fresh = newFits(needs, bounds, {});
    if (before.size() != needs.size()) return fresh;
    const Outcome least = outcomeOf(needs, fresh);
    const double unfitted = unfittedWorst(bounds);
    const auto isWorthKeeping = [&](std::span<const MapFit> fits, double factor) {
        const Outcome found = outcomeOf(needs, fits);
        return found.worst <= std::min(factor * least.worst, unfitted) && found.mean <= factor * least.mean;
    };
    if (areWithin(needs, before) && isWorthKeeping(before, kRefit)) return {before.begin(), before.end()};
    if (kRemembering * least.worst > unfitted) return withoutFits(bounds, fresh);
    std::vector<MapFit> ready = newFits(needs, bounds, before);
    return isWorthKeeping(ready, kRemembering) ? ready : fresh;
}

} // namespace gnomon::shadow
