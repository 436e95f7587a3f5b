// The lit image. A surface that faces away from the light is dark without a shadow lookup. Both sides of a surface are
// lit.
// Values of the macros:
// - SHADOWS: 0 none, 1 maps, 2 a mask texture.
// - AUXILIARY: 1 if surfaces are requested.
// - LIGHT: 1 if reflected light is requested.
// - MANY_PARTITIONS: 1 if the partitions exceed the first uniform block.
// - OVERLAY: 0 none, see overlay.glsl for the others.
#include "shared/frame_block.h"
#include "image/light.glsl"
#include "image/lit_alpha.glsl"
#include "image/shadow_lookup.glsl"
#include "image/overlay.glsl"

in Surface {
    vec3 position;
    vec3 normal;
    vec3 color;
    flat float error;
    flat uint cluster;
};

layout(binding = 1) uniform sampler2D litMask;

layout(location = 0) out vec4 pixel;
#if AUXILIARY
// xyz: flat normal towards the viewer. w: partition + 1 + lit fraction / 2, or -1 if the surface faces away from the
// light.
layout(location = 1) out vec4 auxiliary;
layout(location = 2) out vec4 auxiliaryPosition; // w: 1
#endif

#if LIGHT
layout(location = 1) out vec4 reflected; // linear, before tone mapping; a: 1
#endif

void main() {
    vec3 towardsEye = eye - position;
    vec3 flatNormal = cross(dFdx(position), dFdy(position));
    float size = length(flatNormal);
    flatNormal = size > 0.0 ? flatNormal / size : normalize(towardsEye);
    if (dot(flatNormal, towardsEye) < 0.0) flatNormal = -flatNormal;
    vec3 smoothNormal = normal == vec3(0.0) || isFaceted == 1 ? flatNormal : normalize(normal);
    if (dot(smoothNormal, flatNormal) < 0.0) smoothNormal = -smoothNormal;

    float depth = dot(viewDirection, position) + originDepth;
    vec4 incoming = lightAt(position);
    float cosine = dot(flatNormal, incoming.xyz);
    float lit = 0.0;
    int index = -1;
    if (cosine > 0.0) {
#if SHADOWS == 1
        index = partitionOf(position, depth);
        lit = litFraction(index, position, flatNormal, cosine);
#elif SHADOWS == 2
        lit = texelFetch(litMask, ivec2(gl_FragCoord.xy), 0).r;
#else
        lit = 1.0;
#endif
    }
    float direct = lit * max(dot(smoothNormal, incoming.xyz), 0.0) * incoming.w;
    vec3 light = linearFromDisplay(color) * lightOf(smoothNormal, normalize(towardsEye), direct);
    vec3 shaded = displayFromLinear(toneMapped(light));
#if OVERLAY
    shaded = overlay(shaded, position, flatNormal, depth, index, error, cluster);
#endif
    pixel = vec4(shaded, lit > 0.0 && cosine > 1e-3 ? kLitAlpha : 1.0);
#if LIGHT
    reflected = vec4(light, 1.0);
#endif
#if AUXILIARY
    auxiliary = vec4(flatNormal, cosine > 0.0 ? float(index + 1) + 0.5 * lit : -1.0);
    auxiliaryPosition = vec4(position, 1.0);
#endif
}
