// Divides a period into time steps, and computes the position of the Sun in each step.
#pragma once

#include "core/integer_light.h"
#include "sun/sun_period.h"

#include <string>
#include <vector>

namespace gnomon::sun {

/// A time step and the position of the Sun in its middle, which represents the whole step. Computed starts and ends of
/// sunlight are therefore off by at most half a step.
struct SunStep {
    std::string time; // ISO 8601, in the clock of the period's start
    bool isUp = false;
    IntegerLight light; // the Sun's direction with standard refraction; valid if the Sun is up
};

/// Returns the time steps whose middles are in `period`. At least one step is required (see `settings::requireSteps`).
std::vector<SunStep> sunSteps(const SunPeriod& period);

} // namespace gnomon::sun
