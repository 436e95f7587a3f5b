// The vertex shader of a shadow map, which needs only positions.
#include "shared/geometry.glsl"

invariant gl_Position;

void main() {
    gl_Position = clipFromDraw * vec4(drawPosition(), 1.0);
}
