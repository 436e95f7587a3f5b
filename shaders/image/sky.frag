// The sky behind the model. render/light/background.h defines its parameters, and background.cpp computes the same
// colours.
#include "image/transfer.glsl"

// Four parameters: sine of the elevation of the view direction, sine of the elevation of the image's up direction,
// tangent of half the vertical angle, and image height in pixels.
layout(location = 0) uniform vec4 rows;

layout(location = 0) out vec4 pixel;

const vec3 kZenith = vec3(0.26, 0.42, 0.66);
const vec3 kHorizon = vec3(0.76, 0.82, 0.88);
const vec3 kBelow = vec3(0.36, 0.38, 0.41);
const float kHaze = 0.2;

void main() {
    float above = (2.0 * gl_FragCoord.y / rows.w - 1.0) * rows.z;
    float sine = clamp((rows.x + above * rows.y) / sqrt(1.0 + above * above), -1.0, 1.0);
    float below = min(-sine / kHaze, 1.0);
    vec3 linear = sine >= 0.0 ? mix(kHorizon, kZenith, sqrt(sine)) : mix(kHorizon, kBelow, below * below * (3.0 - 2.0 * below));
    pixel = vec4(displayFromLinear(linear), 1.0);
}
