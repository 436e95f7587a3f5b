// What the shaders are told of a frame: declared once, read by C++ and by GLSL, laid out by std140.
// "draw" space: world axes and units, origin at a grid point near the eye, so that floats are precise where it matters.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace gnomon::executor::block {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
using mat4 = glm::mat4;
#define GNOMON_BLOCK(binding_, name_) struct name_
#else
#define GNOMON_BLOCK(binding_, name_) layout(std140, binding = binding_) uniform name_
#endif

#define GNOMON_MAX_PARTITIONS 96
#define GNOMON_MAX_SLICES 64

GNOMON_BLOCK(0, Frame) {
    mat4 clipFromDraw; // of the pass that is drawn
    ivec4 originCell;  // xyz: the grid point that is draw space's origin
    vec4 eye;          // xyz: the eye in draw space; w: the grid's step
    vec4 view;         // xyz: the view direction; w: the view depth of draw space's origin
    vec4 light;        // xyz: the direction towards the light; w: +1 if it is behind the viewer or across, else -1
    vec4 image;        // width and height in pixels; z: the clip near plane; w: 2 tan(theta) / height
    vec4 near;         // x: the shadow range's near; y: its far; z: error threshold in pixels; w: for the overlay of
                       // residency, why what is drawn now is drawn (executor::Residence)
    ivec4 counts; // x: slices; y: filter width in texels; z: side faces of a slice; w: 1 if the near face has maps of
                  // its own
};

// shadow::MapImage in single precision, for positions in draw space.
struct Partition {
    mat4 clipFromOffset; // position - origin -> (x, y, depth, 1) w, x and y in [-1, 1] over `rectangle`
    vec4 origin;         // xyz: of the offsets; w: the reach of a lookup in texels
    vec4 texel;          // (column, row) of the whole depth texture = clip.xy / clip.w * texel.xy + texel.zw
    vec4 byColumn;       // products with the receiver's plane: its depth changes by byColumn / byDepth a column
    vec4 byRow;
    vec4 byDepth;
    vec4 axisX;     // xyz: the light frame's x in draw space; w: what unevenness changes in depth over a texel along x
    vec4 axisZ;     // and its z; w: the same along z, where the map's w is 1
    vec4 rectangle; // the partition's texels, gutters included: first column, first row, one past the last
};

GNOMON_BLOCK(1, Shadows) {
    vec4 faceFirst[4]; // a face owns p where dot(first, p) >= 0 and dot(second, p) >= 0; p from the eye
    vec4 faceSecond[4];
    vec4 faceEdge[4];               // xyz, w: p is the near face's where dot(xyz, p) < w * near of its slice
    vec4 splits[GNOMON_MAX_SLICES]; // x: near of the slice; y: far
    ivec4 passOfPartition[GNOMON_MAX_PARTITIONS / 4]; // partition: slice * faces a slice + face, near last; -1: no map
    Partition partitions[GNOMON_MAX_PARTITIONS];
};

#ifdef __cplusplus
} // namespace gnomon::executor::block
#endif
