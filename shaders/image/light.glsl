// How much light a surface gets and which colour a screen shows for it: executor/light/light_model.h says what and why.

#include "image/transfer.glsl"

vec3 shoulder(vec3 light) {
    return min(isShouldered == 1 ? light / (1.0 + light) : light, 1.0);
}

// What light a surface gets; `direct` is the cosine to the sun where it shines, else 0.
vec3 lightOf(vec3 normal, vec3 eyeDirection, float direct) {
    float cosine = dot(normal, eyeDirection);
    return ambientMean + ambientTilt * dot(normal, skyAxis) + headlight * cosine * cosine + sun * direct;
}
