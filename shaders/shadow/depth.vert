// One shadow map: position alone.
#include "shared/geometry.glsl"

invariant gl_Position;

void main() {
    gl_Position = clipFromDraw * vec4(drawPosition(), 1.0);
}
