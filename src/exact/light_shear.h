// The shear along the light, in which all of its rays are upright.
#pragma once

#include "core/integer_light.h"

namespace gnomon::exact {

/// The shear along the light that makes it upright: (u, v) says which ray towards the light a point lies on, h how far
/// along it. Its entries are at most 1 in size; determinants keep their size, and change their sign with `sign`.
struct LightShear {
    int along = 1; // the axis of the light's largest component: 0, 1 or 2
    int first = 2; // the other two, cyclically behind it
    int second = 0;
    double firstRatio = 0; // u = p[first] - firstRatio * p[along]
    double secondRatio = 0;
    double sign = 1;      // h = sign * p[along]: larger nearer to the light
    double component = 0; // the size of the largest component: h grows by it over one `direction`
};

LightShear shearAlong(const IntegerLight& light);

} // namespace gnomon::exact
