// Keeps a fragment if the alpha of the image marks its pixel as lit, so that a query can count lit pixels.
#include "image/lit_alpha.glsl"

layout(binding = 0) uniform sampler2D image;

void main() {
    if (abs(texelFetch(image, ivec2(gl_FragCoord.xy), 0).a - kLitAlpha) > 0.5 / 255.0) discard;
}
