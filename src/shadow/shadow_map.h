// One shadow map of a frame: the value that the plan, the backends, the validation and the tests share.
#pragma once

#include "shadow/cube/cube_face.h"
#include "shadow/map_image.h"
#include "shadow/partition/region.h"
#include "shadow/stable_slice.h"

#include <optional>

namespace gnomon::shadow {

/// The aliasing bound of a map over its region: perspective aliasing for the actual map size, viewport and filter.
struct AliasingBound {
    double x = 0;       // along s
    double z = 0;       // along t, as in Lloyd et al. 2006
    double sheared = 0; // along t, with the shear of the texel

    double worst() const { return x > z ? x : z; }
};

/// One shadow map with its region, projection, place in the texture and casters, in camera space.
struct ShadowMap {
    Region region;             // slice, face, vertices and planes; contains the receivers
    WarpedMap warped;          // light frame, kappa, and (s, t, depth) over the map without its borders
    TexelRectangle rectangle;  // place in the depth texture, borders included
    int gutter = 1;            // texels on each side
    double filterTexels = 0;   // width of the filter; 0 is a single lookup
    ConvexVolume casterVolume; // volume of all casters, extended by the reach of the lookup
    AliasingBound aliasingBound;
    std::optional<StablePlace> stable; // only for a stabilised slice
    /// The projection for a point light. It replaces `warped`; only warped.frame is then valid.
    std::optional<CubeFaceProjection> cubeFace;
    /// The origin of float positions. It is a point inside the slice for very thin views (depth ratio below 1.1 or half
    /// angle below one degree), the light for the map of a point light, and 0 otherwise.
    glm::dvec3 origin{0};
    /// The shift of the texel grid, in columns and rows of the depth texture, each at most half a texel. Each sample of
    /// one picture can use a different grid. Lookups and casters need no extra space for the shift.
    glm::dvec2 shift{0};

    /// Returns the rectangle without its borders: the area that a lookup without a filter reads.
    TexelRectangle innerRectangle() const;

    /// Returns the texels along s and t without borders, independent of transposition; `image` is 1.
    Resolution texels() const;

    /// Returns the matrix from (s, t, depth) times w to clip space over the rectangle (MapImage describes clip space).
    /// With logarithmic rows, t is the t of even rows, and w is 1 at the lowest edge of the rectangle.
    glm::dmat4 lightClipFromMap() const;

    /// Returns the number of texture rows over which w grows by a factor of e, for logarithmic rows.
    double rowsPerLog() const;

    glm::dmat4 lightClipFromCamera() const {
        return lightClipFromMap() * (cubeFace ? textureFromCamera(*cubeFace) : textureFromCamera(warped));
    }
};

/// Returns the lookup parameters of `map`, including its shift. `unmovedClipFromOffset` is the matrix without the
/// shift, for positions relative to `origin`.
DoubleMapImage mapImage(const ShadowMap& map, const glm::dmat4& unmovedClipFromOffset, const glm::dvec3& origin);

/// Returns the lookup parameters of `map` for positions in camera space, relative to the map's origin.
DoubleMapImage cameraImage(const ShadowMap& map);

} // namespace gnomon::shadow
