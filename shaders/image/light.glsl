// How much light a surface gets and which colour a screen shows for it: executor/light/light_model.h says what and why.

#include "image/transfer.glsl"

vec3 shoulder(vec3 light) {
    return min(isShouldered == 1 ? light / (1.0 + light) : light, 1.0);
}

// What a screen shows of a surface of that displayed colour; `direct` is the cosine to the sun where it shines, else 0.
vec3 displayedInLight(vec3 color, vec3 normal, vec3 eyeDirection, float direct) {
    float cosine = dot(normal, eyeDirection);
    vec3 light = ambientMean + ambientTilt * dot(normal, skyAxis) + headlight * cosine * cosine + sun * direct;
    return displayFromLinear(shoulder(linearFromDisplay(color) * light));
}
