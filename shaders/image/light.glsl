// The light of a surface and its displayed colour. The file render/light/light_model.h explains the light model.

#include "image/transfer.glsl"

vec3 toneMapped(vec3 light) {
    return min(isToneMapped == 1 ? light / (1.0 + light) : light, 1.0);
}

// Returns the unit direction to the light. w is the brightness of the light at `position` relative to the sun.
vec4 lightAt(vec3 position) {
    if (!(pointReach > 0.0)) return vec4(towardsLight, 1.0);
    vec3 way = towardsLight - position;
    float size = length(way);
    vec3 reaches = way / pointReach;
    return vec4(size > 0.0 ? way / size : vec3(0.0), 1.0 / max(dot(reaches, reaches), 1.0 / 1024.0));
}

// Returns the light of a surface. `direct` is the cosine to the sun if the surface is lit, otherwise 0. For a point
// light, the cosine is multiplied by its brightness.
vec3 lightOf(vec3 normal, vec3 eyeDirection, float direct) {
    float cosine = dot(normal, eyeDirection);
    return ambientMean + ambientTilt * dot(normal, skyAxis) + headlight * cosine * cosine + sun * direct;
}
