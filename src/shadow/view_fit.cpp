#include "shadow/view_fit.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr AxisNeeds::Limits kRowLimits{};
constexpr AxisNeeds::Limits kColumnLimits{32, 8, kColumnParts, kMostColumnDensity, 1};
constexpr float kFading = 0.9F;
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

/// A part of an axis that is to be spaced: the largest need in it and the sum of all.
struct Part {
    double need = 0;
    double sum = 0;
};

/// The mean over `parts` of what `value` makes of each.
template <class Function>
double meanOver(const std::vector<Part>& parts, const Function& value) {
    double sum = 0;
    for (const Part& part : parts)
        sum += value(part);
    return sum / static_cast<double>(parts.size());
}

/// Densities of mean 1 that keep every need over its density at `promise` or below and lower the mean with what is
/// left: the sum of sum / density is least where densities are as the square roots.
FittedAxis::Densities spaced(const std::vector<Part>& parts, double promise, double mostDensity) {
    const auto density = [&](const Part& part, double scale) {
        return std::min(mostDensity, std::max({kLeastDensity, part.need / promise, scale * std::sqrt(part.sum)}));
    };
    double most = 0;
    for (const Part& part : parts)
        most = std::max(most, std::sqrt(part.sum));
    const double high = most > 0 ? 1e6 / most : 1;
    const double scale = largestWithin(
        [&](double tried) { return meanOver(parts, [&](const Part& part) { return density(part, tried); }); }, high);
    FittedAxis::Densities result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = density(parts[i * parts.size() / result.size()], scale);
    return result;
}

} // namespace

void AxisNeeds::add(double at, double need) {
    Bin& bin = bins_[static_cast<std::size_t>(std::clamp(at * kBins, 0.0, kBins - 1.0))];
    bin.isUsed = true;
    bin.need = std::max(bin.need, need);
    bin.sum += need;
}

void AxisNeeds::add(const AxisNeeds& other) {
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        const Bin& more = other.bins_[i];
        bins_[i].isUsed = bins_[i].isUsed || more.isUsed;
        bins_[i].need = std::max(bins_[i].need, more.need);
        bins_[i].sum += more.sum;
    }
}

bool AxisNeeds::areWithin(const FittedAxis& axis) const {
    for (int i = 0; i < kBins; ++i) {
        const bool isInside = i >= axis.low() * kBins && i < axis.high() * kBins;
        if (bins_[static_cast<std::size_t>(i)].isUsed && !isInside) return false;
    }
    return true;
}

AxisNeeds::Found AxisNeeds::under(const FittedAxis& axis) const {
    constexpr double kRounding = 1 + 1e-4; // what maps in single precision lose
    Found found;
    for (int i = 0; i < kBins; ++i) {
        const Bin& bin = bins_[static_cast<std::size_t>(i)];
        if (!(bin.need > 0)) continue;
        const auto density = [&](int k) { return axis.density((k + 0.5) / kBins); };
        const double least = std::min({density(std::max(i - 1, 0)), density(i), density(std::min(i + 1, kBins - 1))});
        found.most = std::max(found.most, bin.need / least * kRounding);
        found.sum += bin.sum / density(i);
    }
    return found;
}

NeedsOfLate AxisNeeds::ofLate(const NeedsOfLate* before) const {
    NeedsOfLate needs{};
    if (before != nullptr)
        for (std::size_t i = 0; i < kFittedParts; ++i)
            needs[i] = (*before)[i] * kFading;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        float& need = needs[i / (kBins / kFittedParts)];
        need = std::max(need, static_cast<float>(bins_[i].need));
    }
    return needs;
}

std::vector<double> AxisNeeds::widened(int slack, const NeedsOfLate* before) const {
    const NeedsOfLate late = ofLate(before);
    std::vector<double> needs(kBins);
    for (int i = 0; i < kBins; ++i) {
        double& need = needs[static_cast<std::size_t>(i)];
        if (before != nullptr) need = double{late[static_cast<std::size_t>(i) / (kBins / kFittedParts)]};
        for (int k = std::max(0, i - slack); k <= std::min(kBins - 1, i + slack); ++k)
            need = std::max(need, bins_[static_cast<std::size_t>(k)].need);
    }
    return needs;
}

FittedAxis AxisNeeds::fit(const Limits& limits, double bound, const NeedsOfLate* before) const {
    const std::vector<double> needs = widened(limits.slack, before);
    int first = kBins;
    int last = 0;
    for (int i = 0; i < kBins; ++i)
        if (bins_[static_cast<std::size_t>(i)].isUsed || needs[static_cast<std::size_t>(i)] > 0) {
            first = std::min(first, i);
            last = i;
        }
    const int step = kBins / limits.steps;
    const int low = std::max(0, first - limits.slack) / step;
    const int high = std::min(kBins - 1, last + limits.slack) / step + 1;
    std::vector<Part> parts(static_cast<std::size_t>(limits.parts));
    const int binsAPart = (high - low) * step / limits.parts;
    double most = 0;
    for (int i = low * step; i < high * step; ++i) {
        Part& part = parts[static_cast<std::size_t>((i - low * step) / binsAPart)];
        const auto bin = static_cast<std::size_t>(i);
        part.need = std::max(part.need, needs[bin]);
        part.sum += bins_[bin].sum;
        most = std::max(most, part.need);
    }
    const auto ends = [&](int at) { return static_cast<double>(at) / limits.steps; };
    FittedAxis::Densities densities{};
    densities.fill(1);
    if (most > 0) {
        const auto mean = [&](double perNeed) {
            return meanOver(parts, [&](const Part& part) {
                return std::clamp(part.need * perNeed, kLeastDensity, limits.mostDensity);
            });
        };
        // In the texels of [low, high], of which there are as many as of all.
        const double share = ends(high - low);
        const double perNeed = largestWithin(mean, limits.mostDensity / most);
        const double promise = std::max(1 / perNeed, std::min(bound / share, limits.promiseSlack / perNeed));
        densities = spaced(parts, promise, limits.mostDensity);
    }
    return {ends(low), ends(high), densities};
}

SampleNeeds::SampleNeeds(const WarpedMap& base, const ViewFrustum& slice)
    : base_(base),
      near_(slice.near * (1 - 1e-6)),
      far_(slice.far * (1 + 1e-6)),
      pixelSlope_(2 * tanHalfY(slice)),
      rowLength_(rowLength(base.kappa, base.length, base.rows)),
      lean_(lean(base.frame)),
      perGrowth_(hasLogRows(base) ? 1 / std::log1p(base.kappa * base.length) : 0) {}

void SampleNeeds::add(const glm::dvec3& p) {
    ++count_;
    const glm::dvec3 light = toLight(base_.frame, p);
    const double zeta = light.z - base_.zMin;
    const double w = std::max(1 + base_.kappa * zeta, 1e-12);
    const double u = light.x / w;
    const double s = (u - base_.uMin) / base_.width;
    const bool isLog = perGrowth_ > 0;
    const double t = isLog ? std::log(w) * perGrowth_ : zeta * (1 + base_.kappa * base_.length) / (base_.length * w);
    const bool isPromised = p.z >= near_ && p.z <= far_;
    const double perPixel = isPromised ? 1 / (pixelSlope_ * p.z) : 0;
    const double shear = base_.kappa * u + lean_;
    alongS_.add(s, base_.width * w * perPixel);
    const double z = rowLength_ * (isLog ? w : w * w) * perPixel;
    alongT_.add(t, z * std::sqrt(1 + shear * shear));
    unsheared_.add(t, z);
}

void SampleNeeds::add(const SampleNeeds& other) {
    count_ += other.count_;
    alongS_.add(other.alongS_);
    alongT_.add(other.alongT_);
    unsheared_.add(other.unsheared_);
}

MapFit SampleNeeds::fit(const Aliasing& bound, const MapFit* before) const {
    const NeedsOfLate* columnsBefore = before == nullptr ? nullptr : &before->columnsOfLate;
    const NeedsOfLate* rowsBefore = before == nullptr ? nullptr : &before->rowsOfLate;
    MapFit result;
    result.columnsOfLate = alongS_.ofLate(columnsBefore);
    result.rowsOfLate = alongT_.ofLate(rowsBefore);
    result.columns = alongS_.fit(kColumnLimits, bound.x, columnsBefore);
    FittedAxis::Densities even{};
    even.fill(1);
    const FittedAxis evenColumns(result.columns.low(), result.columns.high(), even);
    if (alongS_.under(result.columns).most * kWorthColumns > alongS_.under(evenColumns).most)
        result.columns = evenColumns;
    result.rows = alongT_.fit(kRowLimits, bound.z, rowsBefore);
    const Found found = under(result);
    result.unit = {found.x.most, found.sheared.most};
    return result;
}

bool SampleNeeds::areWithin(const MapFit& fit) const {
    return alongS_.areWithin(fit.columns) && alongT_.areWithin(fit.rows);
}

SampleNeeds::Found SampleNeeds::under(const MapFit& fit) const {
    return {alongS_.under(fit.columns), alongT_.under(fit.rows), unsheared_.under(fit.rows).most};
}

WarpedMap fitted(WarpedMap map, const MapFit& fit) {
    map.uMin += fit.columns.low() * map.width;
    map.width *= fit.columns.high() - fit.columns.low();
    map.fitted = std::make_shared<const FittedGrid>(FittedGrid{fit.columns.overAll(), fit.rows});
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
        excess = std::max({excess, found.x.most / unit.x, found.sheared.most / unit.z});
        sum += found.x.sum / unit.x + found.sheared.sum / unit.z;
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
        MapFit fit = needs[i].isEmpty() ? MapFit{} : needs[i].fit(bounds[i], before.empty() ? nullptr : &before[i]);
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
        fits[i].columnsOfLate = fresh[i].columnsOfLate;
        fits[i].rowsOfLate = fresh[i].rowsOfLate;
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
