// Which partition a point belongs to, and whether its map shows it in shadow.

layout(binding = 0) uniform sampler2D shadowDepth;

// The slice with near <= z < far; what lies before the first or behind the last belongs to it.
int sliceOf(float z) {
    int slice = 0;
    while (slice + 1 < sliceCount && z >= slices[slice].far) ++slice;
    return slice;
}

// The face that owns `p` (relative to the eye): the first whose two tests hold, the last needing none, then the near
// face's test. Word for word shadow::ownerOf.
int faceOf(vec3 p, int slice) {
    int face = 0;
    float inside = dot(faceFirst[0].xyz, p);
    while (face + 1 < sideFaceCount) {
        float beyond = dot(faceSecond[face].xyz, p);
        if (inside >= 0.0 && beyond >= 0.0) break;
        inside = -beyond; // the same number for both neighbours, so no rounding makes both deny the point
        ++face;
    }
    bool inNear = hasOwnNear == 1 && dot(faceEdge[face].xyz, p) < faceEdge[face].w * slices[slice].near;
    return inNear ? sideFaceCount : face;
}

// The face of the cube about a point light that is seen through along `offset` from it. Word for word
// shadow::cubeFaceOf.
int cubeFaceOf(vec3 offset) {
    vec3 size = abs(offset);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (offset[axis] < 0.0 ? 1 : 0);
}

int partitionOf(vec3 position, float z) {
    if (pointReach > 0.0) {
        int cubeFace = cubeFaceOf(position - towardsLight);
        return passOfPartition[cubeFace / 4][cubeFace % 4];
    }
    vec3 p = position - eye;
    int slice = sliceOf(z);
    int facesPerSlice = max(sideFaceCount, 1) + hasOwnNear;
    int index = slice * facesPerSlice + (sideFaceCount == 0 ? 0 : faceOf(p, slice));
    return passOfPartition[index / 4][index % 4];
}

vec4 clipOf(Partition part, vec3 p) {
    return part.clipFromOffset * vec4(p - part.origin, 1.0);
}

vec2 texelOf(Partition part, vec4 clip) {
    return clip.xy / clip.w * part.texelScale + part.texelOffset;
}

// How far the receiver's plane, and a neighbour somewhat steeper, may change in depth over half a texel and the kernel,
// in both directions (shadow::receiverBias). `plane` holds the offsets x with dot(plane, (x, 1)) = 0; `w` is the point's.
float receiverBias(Partition part, vec4 plane, float cosine, float w) {
    float across = max(abs(dot(plane, part.byDepth)), 1e-30);
    float slope = (abs(dot(plane, part.byColumn)) + abs(dot(plane, part.byRow))) / across;
    slope *= min(1.0, cosine / 0.1); // grazing receivers would ask for any bias
    // Of a point light both go with the inverse of w.
    float uneven = pointReach > 0.0 ? length(vec2(part.unevenX, part.unevenZ)) / w
                                    : length(vec2(part.unevenX, part.unevenZ * w));
    return (slope + uneven) * part.reach + 6e-7;
}

// The lit fraction of `p` (draw space) on a receiver with flat normal `normal` and cosine `cosine` to the light.
float litFraction(int index, vec3 p, vec3 normal, float cosine) {
    if (index < 0) return 1.0;
    Partition part = partitionAt(index);
    vec4 clip = clipOf(part, p);
    vec2 texel = texelOf(part, clip);
    vec4 plane = vec4(normal, -dot(normal, p - part.origin));
    // Clamped as casters are: behind the map's far end nothing is in the way but what it shows.
    float depth = min(clip.z / clip.w - receiverBias(part, plane, cosine, clip.w), 1.0);
    int width = max(filterTexels, 1);
    ivec2 lowest = ivec2(part.firstTexel);
    ivec2 highest = ivec2(part.endTexel) - 1;
    vec2 start = clamp(texel - 0.5 * float(width - 1), -1e6, 1e6);
    ivec2 first = ivec2(floor(start));
    vec2 fraction = start - floor(start);
    // Between the two squares, a texel narrower than the kernel, whose corners lie around the point's: so the kernel's
    // ends weigh by the fraction of the texel.
    int box = max(width - 1, 1);
    vec2 lit = vec2(0.0); // of the rows of the square above, and of that below
    for (int y = 0; y < width; ++y) {
        vec2 sides = vec2(0.0);
        for (int x = 0; x < width; ++x) {
            ivec2 at = clamp(first + ivec2(x, y), lowest, highest);
            float isLit = depth <= texelFetch(shadowDepth, at, 0).r ? 1.0 : 0.0;
            sides += isLit * vec2(x < box, x >= width - box);
        }
        lit += mix(sides.x, sides.y, fraction.x) * vec2(y < box, y >= width - box);
    }
    return mix(lit.x, lit.y, fraction.y) / float(box * box);
}
