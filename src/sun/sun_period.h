// The period of time over which sun hours are computed.
#pragma once

#include "sun/sun_position.h"

#include <glm/glm.hpp>

namespace gnomon::sun {

/// A period [from, to) at a place on the earth, divided into steps of `stepSeconds`. `up` is the up direction of the
/// world. True north is `northDegrees` clockwise of the model's north, seen from above (see `towardsSun`).
struct SunPeriod {
    Place place;
    CivilTime from;
    CivilTime to;
    double stepSeconds = 900;
    double northDegrees = 0;
    glm::dvec3 up{0, 1, 0};
};

/// Returns the duration of `period` in seconds. It is negative if `to` is earlier than `from`.
double secondsOf(const SunPeriod& period);

/// Returns the number of time steps whose middle is in `period`. The number is whole and can be very large. It is below
/// 1 if there are no such steps.
double stepCount(const SunPeriod& period);

/// Returns the unit vector towards the Sun in world space. `sun` is its position in the sky, above or below the
/// horizon, and `up` is the up direction of the world. True north is `north` degrees clockwise of the world's own
/// north, seen from above. The world's own north is opposite its front: -z if y is up, y if z is up.
glm::dvec3 towardsSun(const SunPosition& sun, double north, const glm::dvec3& up);

} // namespace gnomon::sun
