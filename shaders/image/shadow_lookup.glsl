// Which partition a point belongs to, and whether its map shows it in shadow.

layout(binding = 0) uniform sampler2D shadowDepth;

// The slice with near <= z < far; what lies before the first or behind the last belongs to it.
int sliceOf(float z) {
    int slice = 0;
    while (slice + 1 < counts.x && z >= splits[slice].y) ++slice;
    return slice;
}

// The face through which the ray from `p` (relative to the eye) against the depth leaves the slice: 0 whole, 1 top,
// 2 bottom, 3 left, 4 right, 5 near. The narrowest image beam on the ray lies there.
int faceOf(vec3 p, float z, int slice) {
    if (counts.z == 0) return 0;
    vec3 direction = light.w * light.xyz;
    float slope = -dot(direction, view.xyz);
    float reach = slope > 0.0 ? (z - splits[slice].x) / slope : 3.4e38;
    int face = 5;
    if (faces[2 * slice + 1].y < 0) reach = 3.4e38; // without a map of its own the sides cover it
    for (int i = 0; i < 4; ++i) {
        float towards = dot(sideNormals[i].xyz, direction);
        float inside = max(-dot(sideNormals[i].xyz, p), 0.0);
        if (towards > 1e-12 && inside < reach * towards) {
            reach = inside / towards;
            face = i + 1;
        }
    }
    return face;
}

int partitionOf(vec3 p, float z) {
    int slice = sliceOf(z);
    int face = faceOf(p, z, slice);
    return faces[2 * slice + face / 4][face % 4];
}

// How far the receiver's plane may change in depth over half a texel and the kernel, in both directions: the bias that
// a flat receiver needs, and no more. `plane` holds the points x with dot(plane, (x, 1)) = 0.
float receiverBias(Partition part, vec4 plane, float cosine) {
    vec4 inTexels = plane * part.drawFromTexel;
    float reach = 0.5 + 0.5 * float(max(counts.y, 1) - 1) + 1.0 / 256.0;
    float slope = (abs(inTexels.x) + abs(inTexels.y)) / max(abs(inTexels.z), 1e-30);
    slope *= min(1.0, cosine / 0.1); // grazing receivers would ask for any bias
    return slope * reach + 6e-7;
}

// The lit fraction of `p` (draw space) on a receiver with flat normal `normal` and cosine `cosine` to the light.
float litFraction(int index, vec3 p, vec3 normal, float cosine) {
    if (index < 0) return 1.0;
    Partition part = partitions[index];
    vec4 q = part.texelFromDraw * vec4(p, 1.0);
    vec3 texel = q.xyz / q.w;
    float depth = texel.z - receiverBias(part, vec4(normal, -dot(normal, p)), cosine);
    int width = max(counts.y, 1);
    ivec2 lowest = ivec2(part.rectangle.xy);
    ivec2 highest = ivec2(part.rectangle.zw) - 1;
    ivec2 first = ivec2(floor(texel.xy - 0.5 * float(width - 1)));
    float lit = 0.0;
    for (int y = 0; y < width; ++y)
        for (int x = 0; x < width; ++x) {
            ivec2 at = clamp(first + ivec2(x, y), lowest, highest);
            lit += depth <= texelFetch(shadowDepth, at, 0).r ? 1.0 : 0.0;
        }
    return lit / float(width * width);
}
