#include "viewer/detail_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::viewer {

namespace {

constexpr double kMostStrain = 5; // 32 times the error
constexpr double kGain = 0.25;    // of the octaves between measured and wanted time, a frame
constexpr double kMostStep = 0.25;
constexpr double kDeadBand = 0.15;       // octaves: about a tenth of the time
constexpr double kSliceHysteresis = 0.5; // of strain, before a slice comes back

/// Slices that `strain` takes, where `taken` are gone already.
int slicesTaken(double strain, int taken) {
    const int down = static_cast<int>(std::floor(std::max(strain, 0.0)));
    const int up = static_cast<int>(std::floor(std::max(strain + kSliceHysteresis, 0.0)));
    return std::clamp(taken, down, up);
}

} // namespace

void DetailBudget::measure(double milliseconds, double target) {
    const double octaves = std::log2(std::max(milliseconds, 1e-3) / target);
    if (std::abs(octaves) < kDeadBand) return;
    const double step = std::clamp(kGain * octaves, -kMostStep, kMostStep);
    strain_ = std::clamp(strain_ + step, 0.0, kMostStrain);
    slicesTaken_ = slicesTaken(strain_, slicesTaken_);
}

void DetailBudget::relax() {
    strain_ = 0;
    slicesTaken_ = 0;
}

Effort DetailBudget::effort(const Effort& wanted) const {
    Effort effort = wanted;
    effort.errorPixels = wanted.errorPixels * std::exp2(strain_);
    if (wanted.slices) effort.slices = std::max(1, *wanted.slices - slicesTaken_);
    return effort;
}

std::string DetailBudget::givenUp(const Effort& wanted) const {
    const Effort now = effort(wanted);
    std::string text;
    if (now.errorPixels > wanted.errorPixels) {
        char words[64];
        std::snprintf(words, sizeof words, "detail %.3g -> %.3g px", wanted.errorPixels, now.errorPixels);
        text = words;
    }
    if (now.slices != wanted.slices)
        text += (text.empty() ? "" : ", ") + std::string("slices ") + std::to_string(*wanted.slices) + " -> " +
                std::to_string(*now.slices);
    return text;
}

bool DetailBudget::isExhausted() const {
    return strain_ >= kMostStrain;
}

} // namespace gnomon::viewer
