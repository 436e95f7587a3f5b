// A visible surface: position in camera-relative space, normal and colour.
#include "shared/geometry.glsl"

out Surface {
    vec3 position;
    vec3 normal; // zero: use the normal of the triangle
    vec3 color;
    flat float error;   // the cluster's stored error, in world units
    flat uint cluster;  // colour index of the cluster, three bits
};

invariant gl_Position;

// Decodes an octahedral normal of two snorm16 numbers to a unit vector (Meyer et al. 2010).
vec3 octahedral(uint bits) {
    vec2 e = unpackSnorm2x16(bits);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
}

void main() {
    position = drawPosition();
    normal = normalBits == 0x80008000u ? vec3(0.0) : octahedral(normalBits);
    color = colorAndError.rgb;
    float code = round(colorAndError.a * 255.0);
    error = code == 0.0 ? 0.0 : gridStep * exp2((code - 9.0) / 8.0);
    uvec3 top = gridPoint >> 31u;
    cluster = top.x | top.y << 1u | top.z << 2u;
    gl_Position = clipFromDraw * vec4(position, 1.0);
}
