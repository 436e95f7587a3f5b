// Passes the fragment if the image's alpha marks the pixel as lit.
#include "image/lit_alpha.glsl"

layout(binding = 0) uniform sampler2D image;

void main() {
    if (abs(texelFetch(image, ivec2(gl_FragCoord.xy), 0).a - kLitAlpha) > 0.5 / 255.0) discard;
}
