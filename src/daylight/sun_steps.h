// A period cut into steps, and where the Sun stands in each.
#pragma once

#include "core/integer_light.h"
#include "settings/sun_period.h"

#include <string>
#include <vector>

namespace gnomon::daylight {

/// The middle of one step. Each step stands for its whole length, so what begins or ends within it is off by at most
/// half of it.
struct SunStep {
    std::string time; // ISO 8601 by the clock of the period's beginning
    bool isUp = false;
    IntegerLight light; // where the Sun is up, as the usual air shows it
};

/// The steps of a period: those whose middles lie in it. Throws UsageError where there is none, or too many.
std::vector<SunStep> sunSteps(const settings::SunPeriod& period);

} // namespace gnomon::daylight
