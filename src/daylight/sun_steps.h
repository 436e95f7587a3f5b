// A period divided into time steps, with the position of the Sun at each step.
#pragma once

#include "core/integer_light.h"
#include "settings/sun_period.h"

#include <string>
#include <vector>

namespace gnomon::daylight {

/// The middle of one time step. It represents the whole step, so a start or an end of sunlight is off by at most half a
/// step.
struct SunStep {
    std::string time; // ISO 8601, in the clock of the period's start
    bool isUp = false;
    IntegerLight light; // the Sun's direction with standard refraction; valid if the Sun is up
};

/// Returns the steps whose middles lie in the period. Throws UsageError if there are none or too many.
std::vector<SunStep> sunSteps(const settings::SunPeriod& period);

} // namespace gnomon::daylight
