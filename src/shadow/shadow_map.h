// One shadow map of a frame: the value that plan, executors, proofs and tests share.
#pragma once

#include "shadow/cube/cube_face.h"
#include "shadow/map_image.h"
#include "shadow/partition/region.h"
#include "shadow/stable_slice.h"

#include <optional>

namespace gnomon::shadow {

/// What a map promises over its region: the perspective aliasing, with real sizes, viewport and kernel.
struct PromisedAliasing {
    double x = 0;       // along s
    double z = 0;       // along t, the paper's measure
    double sheared = 0; // along t, with the shear of the texel

    double worst() const { return x > z ? x : z; }
};

/// One map of a region, in camera space.
struct ShadowMap {
    Region region;             // slice, face, vertices and planes: its receivers
    WarpedMap warped;          // light frame, kappa, and (s, t, depth) over the map without its gutters
    TexelRectangle rectangle;  // in the depth texture, gutters included
    int gutter = 1;            // texels on each side
    double filterTexels = 0;   // width of the kernel; 0 is a single lookup
    ConvexVolume casterVolume; // all that can throw a shadow into the region, grown by the lookup's reach
    PromisedAliasing promised;
    std::optional<StablePlace> stable; // of a stabilised slice's map
    /// Of a point light's map, in place of `warped`, of which the frame alone holds then.
    std::optional<CubeFaceProjection> cubeFace;
    /// For views so thin (depth ratio under 1.1 or half angle under a degree) that float positions must be relative to
    /// a point inside the slice: that point; of a point light's map the light; else 0.
    glm::dvec3 origin{0};
    /// Columns and rows of the depth texture by which the grid of texels is moved, each at most half a texel: the
    /// samples of one picture see different grids. Lookups and casters need no more room for it.
    glm::dvec2 shift{0};

    /// What a lookup reads without a kernel: the rectangle without its gutters.
    TexelRectangle innerRectangle() const;

    /// Texels along s and t without gutters, whichever way the map lies in the depth texture; `image` is 1.
    Resolution texels() const;

    /// (s, t, depth) over the map, times w -> clip space over the rectangle, as MapImage has it. With logarithmic rows
    /// t is that of even ones, and w is 1 on the rectangle's lowest edge.
    glm::dmat4 lightClipFromMap() const;

    /// Rows of the texture by which w grows e times, where they are logarithmic.
    double rowsPerLog() const;

    glm::dmat4 lightClipFromCamera() const {
        return lightClipFromMap() * (cubeFace ? textureFromCamera(*cubeFace) : textureFromCamera(warped));
    }
};

/// The image of `map`, moved by its shift, for positions of which `unmovedClipFromOffset` makes clip space without it
/// once `origin` is subtracted.
DoubleMapImage mapImage(const ShadowMap& map, const glm::dmat4& unmovedClipFromOffset, const glm::dvec3& origin);

/// The image of `map` for positions in camera space, relative to the map's origin.
DoubleMapImage cameraImage(const ShadowMap& map);

} // namespace gnomon::shadow
