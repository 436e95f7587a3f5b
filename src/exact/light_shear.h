// The shear of space that makes all rays of a directional light parallel to the h axis.
#pragma once

#include "core/integer_light.h"

namespace gnomon::exact {

/// The shear of space along a light direction. It maps a point to (u, v, h): (u, v) identifies the light ray through
/// the point, and h is the position along the ray. All entries of the shear matrix are in [-1, 1]. The shear preserves
/// the absolute value of determinants, and changes their sign if `sign` is -1.
struct LightShear {
    int along = 1; // axis of the largest component of the light direction: 0, 1 or 2
    int first = 2; // the other two axes, in cyclic order
    int second = 0;
    double firstRatio = 0; // u = p[first] - firstRatio * p[along]
    double secondRatio = 0;
    double sign = 1;      // h = sign * p[along]: larger is nearer to the light
    double component = 0; // absolute value of the largest component: the change of h along one `direction`
};

LightShear shearAlong(const IntegerLight& light);

} // namespace gnomon::exact
