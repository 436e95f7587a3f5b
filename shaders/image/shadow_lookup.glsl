// Finds the shadow-map partition of a point and looks up the point in the map of this partition.

layout(binding = 0) uniform sampler2D shadowDepth;

// Returns the slice with near <= z < far. Points before the first slice belong to the first, and points behind the last
// slice to the last.
int sliceOf(float z) {
    int slice = 0;
    while (slice + 1 < sliceCount && z >= slices[slice].far) ++slice;
    return slice;
}

// Returns the face partition of `p` (relative to the eye): the first face whose two tests succeed, or the last face.
// Then tests whether `p` belongs to the near face instead. The result is identical to shadow::partitionIndex.
int faceOf(vec3 p, int slice) {
    int face = 0;
    float inside = dot(faceFirst[0].xyz, p);
    while (face + 1 < sideFaceCount) {
        float insideSecond = dot(faceSecond[face].xyz, p);
        if (inside >= 0.0 && insideSecond >= 0.0) break;
        inside = -insideSecond; // Neighbouring faces use the same number, so rounding cannot exclude a point from both.
        ++face;
    }
    bool inNear = hasOwnNear == 1 && dot(faceEdge[face].xyz, p) < faceEdge[face].w * slices[slice].near;
    return inNear ? sideFaceCount : face;
}

// Returns the face of the cube around a point light that contains the direction `offset`. The result is identical to
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

// Returns the bias of a receiver, as shadow::receiverBias does. It covers the depth change of the receiver's plane, and
// of a somewhat steeper neighbour, over half a texel and the filter kernel in both directions. `plane` is the
// receiver's plane: all offsets x with dot(plane, (x, 1)) = 0. `w` is the homogeneous w of the point.
float receiverBias(Partition part, vec4 plane, float cosine, float w) {
    float across = max(abs(dot(plane, part.byDepth)), 1e-30);
    float slope = (abs(dot(plane, part.byColumn)) + abs(dot(plane, part.byRow))) / across;
    slope *= min(1.0, cosine / 0.1); // without this, grazing receivers would have an unlimited bias
    // For a point light, the depth changes along both axes are proportional to 1/w.
    float uneven = pointReach > 0.0 ? length(vec2(part.unevenX, part.unevenZ)) / w
                                    : length(vec2(part.unevenX, part.unevenZ * w));
    return (slope + uneven) * part.reach + 6e-7;
}

// Returns the lit fraction of point `p` (camera-relative space) on a receiver. `normal` is the flat normal of the
// receiver, and `cosine` is the cosine between it and the light direction. `index` is the partition.
float litFraction(int index, vec3 p, vec3 normal, float cosine) {
    if (index < 0) return 1.0;
    Partition part = partitionAt(index);
    vec4 clip = clipOf(part, p);
    vec2 texel = texelOf(part, clip);
    vec4 plane = vec4(normal, -dot(normal, p - part.origin));
    // Clamps to the far end of the map, like the depths of casters. For a receiver behind the far end, the map contains
    // all casters.
    float depth = min(clip.z / clip.w - receiverBias(part, plane, cosine, clip.w), 1.0);
    int width = max(filterTexels, 1);
    ivec2 lowest = ivec2(part.firstTexel);
    ivec2 highest = ivec2(part.endTexel) - 1;
    vec2 start = clamp(texel - 0.5 * float(width - 1), -1e6, 1e6);
    ivec2 first = ivec2(floor(start));
    vec2 fraction = start - floor(start);
    // Interpolates between two squares that are one texel narrower than the kernel. The outer texels of the kernel
    // therefore get fractional weights.
    int box = max(width - 1, 1);
    vec2 lit = vec2(0.0); // x: sum over the first `box` rows, y: over the last `box` rows
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
