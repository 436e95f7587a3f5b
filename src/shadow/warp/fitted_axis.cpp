#include "shadow/warp/fitted_axis.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

FittedAxis::Densities evenDensities() {
    FittedAxis::Densities densities{};
    densities.fill(1);
    return densities;
}

/// The part that holds `place`, counted in parts.
std::size_t heldPart(double place) {
    return static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, kFittedParts - 1.0));
}

} // namespace

FittedAxis::FittedAxis() : FittedAxis(0, 1, evenDensities()) {}

FittedAxis::FittedAxis(double low, double high, const Densities& densities)
    : low_(low), high_(high), densities_(densities) {
    GNOMON_CHECK(low < high);
    // Sums with what each addition loses (Knuth's two-sum): over a sparse part that is up to 128 times as much.
    double sum = 0;
    double lost = 0;
    std::array<double, kFittedParts> before{};
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        GNOMON_CHECK(densities[i] > 0);
        before[i] = sum + lost;
        const double next = sum + densities[i];
        const double added = next - sum;
        lost += (sum - (next - added)) + (densities[i] - added);
        sum = next;
    }
    sum += lost;
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        starts_[i] = before[i] / sum;
        densities_[i] = densities[i] * kFittedParts / sum;
    }
    starts_[kFittedParts] = 1;
}

std::size_t FittedAxis::part(double t) const {
    return heldPart((t - low_) / (high_ - low_) * kFittedParts);
}

double FittedAxis::at(double t) const {
    const double place = (t - low_) / (high_ - low_) * kFittedParts;
    const std::size_t i = heldPart(place);
    return starts_[i] + (place - static_cast<double>(i)) * densities_[i] / kFittedParts;
}

double FittedAxis::inverse(double row) const {
    const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, row);
    const auto i = static_cast<std::size_t>(after - starts_.begin()) - 1;
    const double place = static_cast<double>(i) + (row - starts_[i]) * kFittedParts / densities_[i];
    return low_ + place / kFittedParts * (high_ - low_);
}

double FittedAxis::leastDensity() const {
    return *std::min_element(densities_.begin(), densities_.end()) / (high_ - low_);
}

double FittedAxis::greatestDensity() const {
    return *std::max_element(densities_.begin(), densities_.end()) / (high_ - low_);
}

} // namespace gnomon::shadow
