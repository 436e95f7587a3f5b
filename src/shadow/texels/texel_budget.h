// The split of a texel budget over the maps of a frame that makes the largest error the same everywhere.
#pragma once

#include "shadow/texels/packing.h"

#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// The texels along s and t at which a map's aliasing is 1: the critical resolution of the paper (section 4.2), M_x and
/// M_z at unit map resolutions times the image's height in pixels and the filter's width in texels.
struct TexelDemand {
    double s = 0;
    double t = 0;
};

/// What the split has to keep to.
struct TexelLimits {
    std::uint64_t texels = 4194304; // of all maps together, gutters included
    int gutter = 1;                 // texels on each side of a map
    int minSide = 4;                // of a map without its gutters
    int maxSide = 16384;            // of a map with its gutters, and of the texture
    int margin = 0;                 // texels along each axis of a map that do not refine it: what snapping takes
    bool mayTranspose = true;       // maps may lie on their sides
};

/// The maps in one texture.
struct TexelLayout {
    Packing packing; // rectangles with gutters; its area is at most the budget
    int gutter = 1;
    int margin = 0;
    bool equalSquares = false; // nothing better was found than the same square for every map

    /// Texels of map `i` along s and along t, without gutters.
    int texelsS(std::size_t i) const {
        const TexelRectangle& r = packing.rectangles[i];
        return (r.transposed ? r.height : r.width) - 2 * gutter;
    }

    int texelsT(std::size_t i) const {
        const TexelRectangle& r = packing.rectangles[i];
        return (r.transposed ? r.width : r.height) - 2 * gutter;
    }
};

/// The error of one map with `layout`: the larger of demand over texels (less the margin) along s and t.
double mapError(const TexelLayout& layout, std::size_t map, const TexelDemand& demand);

/// The split that makes mapError equal over all maps, within the rounding to whole texels, and as small as the budget
/// allows (Lloyd et al. 2006, Eqs 13 and 14, for any number of maps); or equal squares where the rectangles pack so
/// badly that those do better. The texture's shape is free. Throws gnomon::Error if the budget does not hold maps of
/// the least size.
TexelLayout splitTexels(std::span<const TexelDemand> demands, const TexelLimits& limits);

/// The texels, gutters and packing included, with which splitTexels keeps the error at most `aliasing` (> 0); 0 where
/// the limit on the sides lets no number of them do. limits.texels is ignored.
std::uint64_t texelsThatWouldDo(std::span<const TexelDemand> demands, double aliasing, const TexelLimits& limits);

} // namespace gnomon::shadow
