// Describes a shadow map of a frame as a value. The plan, the backends, the validation and the tests share this type.
#pragma once

#include "shadow/cube/cube_face.h"
#include "shadow/map_image.h"
#include "shadow/partition/region.h"
#include "shadow/stable_slice.h"

#include <optional>

namespace gnomon::shadow {

/// The aliasing bound of a map over its region: the max perspective aliasing for the real map size, viewport and
/// filter.
struct AliasingBound {
    double x = 0;       // along s
    double z = 0;       // along t, as in Lloyd et al. 2006
    double sheared = 0; // along t, with the shear of the texel

    double worst() const { return x > z ? x : z; }
};

/// A shadow map with its region, projection, rectangle in the texture and caster volume, in camera space.
struct ShadowMap {
    Region region; // the part of the view that the map covers, with all its receivers
    // light-space axes, kappa, and the projection to (s, t, depth) over the map without its borders
    WarpedMap warped;
    TexelRectangle rectangle;  // place in the depth texture, borders included
    int gutter = 1;            // border on each side, in texels
    double filterTexels = 0;   // width of the PCF filter in texels; 0: no filter
    ConvexVolume casterVolume; // volume of all casters of the map, extended by the reach of the lookup
    AliasingBound aliasingBound;
    std::optional<StablePlace> stable; // place of the map in the world; only for a stabilised slice
    /// The projection for a point light. It replaces `warped`; only warped.frame is then valid.
    std::optional<CubeFaceProjection> cubeFace;
    /// The origin of the float positions that drawing uses. For very thin views (depth ratio below 1.1 or half angle
    /// below one degree), the origin is a point inside the slice. For the map of a point light, it is the light. In all
    /// other cases it is 0.
    glm::dvec3 origin{0};
    /// The shift of the texel grid, in columns and rows of the depth texture, each at most half a texel. Each frame of
    /// an accumulated image can use another shift. Lookups and casters need no extra space for the shift.
    glm::dvec2 shift{0};

    /// Returns the map's rectangle in the depth texture without its borders: the area that a lookup without a filter
    /// reads.
    TexelRectangle innerRectangle() const;

    /// Returns the numbers of texels of the map along s and t without borders, also for a transposed map. The member
    /// `image` is 1.
    Resolution texels() const;

    /// Returns the matrix from (s, t, depth) times w to the clip space in which the map is drawn (see MapImage). For a
    /// map with logarithmic rows, t is the t of even rows, and w is 1 at the lowest edge of the rectangle.
    glm::dmat4 lightClipFromMap() const;

    /// Returns the number of texture rows over which w grows by the factor e. Requires logarithmic rows.
    double rowsPerLog() const;

    glm::dmat4 lightClipFromCamera() const {
        return lightClipFromMap() * (cubeFace ? textureFromCamera(*cubeFace) : textureFromCamera(warped));
    }
};

/// Returns the lookup parameters of `map`, including the shift of its texel grid. `unmovedClipFromOffset` is the matrix
/// to clip space without the shift, for positions relative to `origin`.
DoubleMapImage mapImage(const ShadowMap& map, const glm::dmat4& unmovedClipFromOffset, const glm::dvec3& origin);

/// Returns the lookup parameters of `map` for positions in camera space, relative to the map's origin.
DoubleMapImage cameraImage(const ShadowMap& map);

} // namespace gnomon::shadow
