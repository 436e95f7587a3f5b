// Distributes a texel budget over the shadow maps of a frame, so that the max aliasing of all maps is equal.
#pragma once

#include "shadow/texels/packing.h"

#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// The numbers of texels along s and t at which the aliasing of a shadow map is 1: the critical resolution (Lloyd et
/// al. 2006, section 4.2). The critical resolution is M_x and M_z at unit map resolutions, times the image height in
/// pixels, times the filter width in texels.
struct TexelDemand {
    double s = 0;
    double t = 0;
};

/// The limits for the distribution of texels over shadow maps.
struct TexelLimits {
    std::uint64_t texels = 4194304; // total of all maps, borders included
    int gutter = 1;                 // border on each side of a map, in texels
    int minSide = 4;                // min side of a map without its borders
    int maxSide = 16384;            // max side of a map with its borders, and of the texture
    int margin = 0;                 // texels along each axis that snapping needs and that add no resolution
    bool mayTranspose = true;       // true: the packing may transpose maps
};

/// The rectangles of all shadow maps in one texture.
struct TexelLayout {
    Packing packing; // rectangles including borders; the area of the texture is within the budget
    int gutter = 1;
    int margin = 0;
    bool equalSquares = false; // true: all maps have squares of equal size, because no other layout was better

    /// texelsS and texelsT return the number of texels of map `i` along s and along t, without borders.
    int texelsS(std::size_t i) const {
        const TexelRectangle& r = packing.rectangles[i];
        return (r.transposed ? r.height : r.width) - 2 * gutter;
    }

    int texelsT(std::size_t i) const {
        const TexelRectangle& r = packing.rectangles[i];
        return (r.transposed ? r.width : r.height) - 2 * gutter;
    }
};

/// Returns the aliasing of one map in `layout`: the texels that it needs for an aliasing of 1, divided by its texels
/// without the margin. The result is the max over s and t.
double mapError(const TexelLayout& layout, std::size_t map, const TexelDemand& demand);

/// Distributes the texel budget over the maps so that their aliasing (mapError) is equal, except for rounding to whole
/// texels, and as small as the budget permits (Lloyd et al. 2006, Eqs 13 and 14, for any number of maps). If the
/// packing of different rectangles wastes too much area, all maps receive equal squares. The texture may have any
/// shape. Throws gnomon::Error if the budget is too small for all maps at their min size.
TexelLayout splitTexels(std::span<const TexelDemand> demands, const TexelLimits& limits);

/// Returns the number of texels with which splitTexels achieves an aliasing of at most `aliasing` (> 0). The number
/// includes borders and packing losses. Returns 0 if the max side of the texture makes this aliasing impossible. The
/// function ignores limits.texels.
std::uint64_t requiredTexels(std::span<const TexelDemand> demands, double aliasing, const TexelLimits& limits);

} // namespace gnomon::shadow
