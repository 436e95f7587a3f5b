// The uniform blocks of a frame, declared once for C++ and GLSL in the std140 layout. "Camera-relative space":
// world axes and units, with the origin at a grid point near the eye, so that floats are precise near the eye.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace gnomon::render::block {
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

// A vec3 and the following scalar share a slot of 16 bytes, in std140 as in C++.
GNOMON_BLOCK(0, Frame) {
    mat4 clipFromDraw;  // of the current pass
    ivec3 originCell;   // grid point that is the origin of camera-relative space
    int filterTexels;   // width of the filter kernel
    vec3 eye;           // in camera-relative space
    float gridStep;     // in world units
    vec3 viewDirection; // in camera-relative space
    float originDepth;  // view depth of the origin of camera-relative space
    vec3 towardsLight;  // in camera-relative space
    float pixelSlope;   // 2 tan(theta) / height: a pixel's height at view depth 1
    int sliceCount;
    int sideFaceCount;    // per slice
    int hasOwnNear;       // 1 if the near face has its own maps
    float errorPixels;    // error limit
    float drawnResidence; // for the residency overlay: reason of the current draws (render::Residence)
    int isFaceted;        // 1 if surfaces use the normals of their triangles
    int isToneMapped;     // 1 if light x is tone-mapped to x / (1 + x)
    int unusedInt;
    // The light of a surface with normal n, in linear RGB (render/light/light_model.h), is ambientMean + ambientTilt
    // (n.skyAxis) + headlight (n.v)^2, plus sun max(n.l, 0) if the surface is lit.
    vec3 ambientMean;
    float headlight;
    vec3 ambientTilt;
    // 0 for a distant light. Otherwise the light is a point at towardsLight that is as bright as the sun at the
    // distance pointReach.
    float pointReach;
    vec3 sun;
    float unusedY;
    vec3 skyAxis; // in camera-relative space
    float unusedZ;
};

// shadow::MapImage in single precision, for positions in camera-relative space.
struct Partition {
    mat4 clipFromOffset; // position - origin -> (x, y, depth, 1) w, with x and y in [-1, 1] over the partition
    vec3 origin;         // origin of the offsets
    float reach;         // half-width of a lookup, in texels
    vec2 texelScale;     // (column, row) of the whole depth texture = clip.xy / clip.w * texelScale + texelOffset
    vec2 texelOffset;
    vec4 byColumn; // dot products with the receiver's plane: its depth changes by byColumn / byDepth per column
    vec4 byRow;
    vec4 byDepth;
    vec3 axisX;      // the light frame's x axis in camera-relative space
    float unevenX;   // depth change per texel along x of a slightly uneven receiver
    vec3 axisZ;      // the light frame's z axis in camera-relative space
    float unevenZ;   // the same along z, where the map's w is 1
    vec2 firstTexel; // first column and row of the partition, including gutters
    vec2 endTexel;   // one past the last
    float logRows;   // 1 if rows are logarithmic, see shadow::MapImage; always 0 with OpenGL
    float unusedPart;
    vec2 unusedPair;
};

struct Slice {
    float near; // view depths
    float far;
    vec2 unused;
};

GNOMON_BLOCK(1, Shadows) {
    vec4 faceFirst[4]; // a face contains p (relative to the eye) if dot(first, p) >= 0 and dot(second, p) >= 0
    vec4 faceSecond[4];
    vec4 faceEdge[4]; // xyz, w: p belongs to the near face if dot(xyz, p) < w * near of its slice
    Slice slices[GNOMON_MAX_SLICES];
    // Pass per partition, or -1 without a map. The partition is slice * faces per slice + face, with near as the last
    // face.
    ivec4 passOfPartition[GNOMON_MAX_PARTITIONS / 4];
#ifdef __cplusplus
    vec4 unused[12]; // padding to a multiple of 256 bytes, the alignment of a separate block in OpenGL
    Partition partitions[GNOMON_MAX_PARTITIONS];
#endif
};

// OpenGL uses several blocks, because it guarantees only 16 KiB per block.
#define GNOMON_FIRST_PARTITIONS 64
#ifndef __cplusplus
GNOMON_BLOCK(2, FirstPartitions) {
    Partition firstPartitions[GNOMON_FIRST_PARTITIONS];
};

GNOMON_BLOCK(3, OtherPartitions) {
    Partition otherPartitions[GNOMON_MAX_PARTITIONS - GNOMON_FIRST_PARTITIONS];
};

/// Returns a partition. For index -1 (no map) it returns an arbitrary one, because some compilers reject a read at a
/// negative index.
Partition partitionAt(int index) {
    index = max(index, 0);
#if MANY_PARTITIONS
    if (index >= GNOMON_FIRST_PARTITIONS) return otherPartitions[index - GNOMON_FIRST_PARTITIONS];
#endif
    return firstPartitions[index];
}
#endif

#ifdef __cplusplus
} // namespace gnomon::render::block
#endif
