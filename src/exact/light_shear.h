// The shear along the light. In the sheared space all light rays are parallel to the h axis.
#pragma once

#include "core/integer_light.h"

namespace gnomon::exact {

/// The shear that makes light rays parallel to the h axis. (u, v) identifies the ray of a point, and h is the position
/// along the ray. The absolute entries are at most 1. Determinants keep their absolute value and change their sign with
/// `sign`.
struct LightShear {
    int along = 1; // axis of the largest component of the light direction: 0, 1 or 2
    int first = 2; // the other two axes, in cyclic order
    int second = 0;
    double firstRatio = 0; // u = p[first] - firstRatio * p[along]
    double secondRatio = 0;
    double sign = 1;      // h = sign * p[along]: larger is nearer to the light
    double component = 0; // absolute value of the largest component: h grows by it per `direction`
};

LightShear shearAlong(const IntegerLight& light);

} // namespace gnomon::exact
