// A period divided into time steps, with the position of the Sun at each step.
#pragma once

#include "core/integer_light.h"
#include "sun/sun_period.h"

#include <string>
#include <vector>

namespace gnomon::sun {

/// One time step, represented by its middle. A start or an end of sunlight is therefore off by at most half a step.
struct SunStep {
    std::string time; // ISO 8601, in the clock of the period's start
    bool isUp = false;
    IntegerLight light; // the Sun's direction with standard refraction; valid if the Sun is up
};

/// Returns the steps whose middles lie in the period; there is at least one (see `settings::requireSteps`).
std::vector<SunStep> sunSteps(const SunPeriod& period);

} // namespace gnomon::sun
