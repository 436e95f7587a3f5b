// How much light a surface gets and which colour a screen shows for it: executor/light/light_model.h says what and why.

#include "image/transfer.glsl"

vec3 shoulder(vec3 light) {
    return min(isShouldered == 1 ? light / (1.0 + light) : light, 1.0);
}

// The direction to the light, of unit length, and how bright it is there, of the sun.
vec4 lightAt(vec3 position) {
    if (!(pointReach > 0.0)) return vec4(towardsLight, 1.0);
    vec3 way = towardsLight - position;
    float size = length(way);
    vec3 reaches = way / pointReach;
    return vec4(size > 0.0 ? way / size : vec3(0.0), 1.0 / max(dot(reaches, reaches), 1.0 / 1024.0));
}

// What light a surface gets; `direct` is the cosine to the sun where it shines, else 0,
// and to a point light that times its brightness.
vec3 lightOf(vec3 normal, vec3 eyeDirection, float direct) {
    float cosine = dot(normal, eyeDirection);
    return ambientMean + ambientTilt * dot(normal, skyAxis) + headlight * cosine * cosine + sun * direct;
}
