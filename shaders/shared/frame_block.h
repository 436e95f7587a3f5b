// What the shaders are told of a frame: declared once, read by C++ and by GLSL, laid out by std140.
// "draw" space: world axes and units, origin at a grid point near the eye, so that floats are precise where it matters.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace gnomon::executor::block {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using ivec3 = glm::ivec3;
using mat4 = glm::mat4;
#define GNOMON_BLOCK(binding_, name_) struct name_
#else
#define GNOMON_BLOCK(binding_, name_) layout(std140, binding = binding_) uniform name_
#endif

#define GNOMON_MAX_PARTITIONS 96
#define GNOMON_MAX_SLICES 64

// A three-component vector and the scalar behind it share one slot of 16 bytes, in std140 as in C++.
GNOMON_BLOCK(0, Frame) {
    mat4 clipFromDraw;  // of the pass that is drawn
    ivec3 originCell;   // the grid point that is draw space's origin
    int filterTexels;   // width of the filter
    vec3 eye;           // in draw space
    float gridStep;     // the grid's step, world units
    vec3 viewDirection; // draw space
    float originDepth;  // the view depth of draw space's origin
    vec3 towardsLight;  // draw space
    float pixelSlope;   // 2 tan(theta) / height: a pixel's height at view depth 1
    int sliceCount;
    int sideFaceCount;    // of a slice
    int hasOwnNear;       // 1 if the near face has maps of its own
    float errorPixels;    // the error threshold
    float drawnResidence; // for the overlay of residency, why what is drawn now is drawn (executor::Residence)
    int isFaceted;        // 1 if surfaces are shaded by the normals of their triangles
    int isShouldered;     // 1 if what is reflected, x, is shown as x / (1 + x)
    int unusedInt;
    // The light at a surface of normal n, linear RGB (executor/light/light_model.h):
    // ambientMean + ambientTilt (n.skyAxis) + headlight (n.v)^2 + sun, where it shines, max(n.l, 0).
    vec3 ambientMean;
    float headlight;
    vec3 ambientTilt;
    float pointReach; // 0; else the light is a point at towardsLight, as bright as the sun so far away
    vec3 sun;
    float unusedY;
    vec3 skyAxis; // draw space
    float unusedZ;
};

// shadow::MapImage in single precision, for positions in draw space.
struct Partition {
    mat4 clipFromOffset; // position - origin -> (x, y, depth, 1) w, x and y in [-1, 1] over the partition
    vec3 origin;         // of the offsets
    float reach;         // of a lookup, in texels
    vec2 texelScale;     // (column, row) of the whole depth texture = clip.xy / clip.w * texelScale + texelOffset
    vec2 texelOffset;
    vec4 byColumn; // products with the receiver's plane: its depth changes by byColumn / byDepth a column
    vec4 byRow;
    vec4 byDepth;
    vec3 axisX;      // the light frame's x in draw space
    float unevenX;   // what unevenness changes in depth over a texel along x
    vec3 axisZ;      // the light frame's z in draw space
    float unevenZ;   // the same along z, where the map's w is 1
    vec2 firstTexel; // of the partition, gutters included: column and row
    vec2 endTexel;   // one past the last
    float logRows;   // 1 where rows lie logarithmically, as shadow::MapImage says; OpenGL is never given such maps
    float unusedPart;
    vec2 unusedPair;
};

struct Slice {
    float near; // view depths
    float far;
    vec2 unused;
};

GNOMON_BLOCK(1, Shadows) {
    vec4 faceFirst[4]; // a face owns p where dot(first, p) >= 0 and dot(second, p) >= 0; p from the eye
    vec4 faceSecond[4];
    vec4 faceEdge[4]; // xyz, w: p is the near face's where dot(xyz, p) < w * near of its slice
    Slice slices[GNOMON_MAX_SLICES];
    ivec4 passOfPartition[GNOMON_MAX_PARTITIONS / 4]; // partition: slice * faces a slice + face, near last; -1: no map
#ifdef __cplusplus
    vec4 unused[12]; // what follows begins at a multiple of 256 bytes, as OpenGL asks of a block of its own
    Partition partitions[GNOMON_MAX_PARTITIONS];
#endif
};

// For OpenGL in blocks of at most 16 KiB, which is what each has.
#define GNOMON_FIRST_PARTITIONS 64
#ifndef __cplusplus
GNOMON_BLOCK(2, FirstPartitions) {
    Partition firstPartitions[GNOMON_FIRST_PARTITIONS];
};

GNOMON_BLOCK(3, OtherPartitions) {
    Partition otherPartitions[GNOMON_MAX_PARTITIONS - GNOMON_FIRST_PARTITIONS];
};

/// At -1, where there is no map, some other one: compilers that see that index at every pixel refuse to read there.
Partition partitionAt(int index) {
    index = max(index, 0);
#if MANY_PARTITIONS
    if (index >= GNOMON_FIRST_PARTITIONS) return otherPartitions[index - GNOMON_FIRST_PARTITIONS];
#endif
    return firstPartitions[index];
}
#endif

#ifdef __cplusplus
} // namespace gnomon::executor::block
#endif
