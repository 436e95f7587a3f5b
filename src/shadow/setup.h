// The shadow maps of one frame as one value: from view, light and scheme to partitions with matrices, texels, caster
// volumes, bias and the aliasing that they promise.
#pragma once

#include "shadow/caster_volume.h"
#include "shadow/depth_bias.h"
#include "shadow/partition/region.h"
#include "shadow/scheme.h"
#include "shadow/stable_slice.h"
#include "shadow/texels/texel_budget.h"
#include "shadow/warp/orientation.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::shadow {

/// What a frame looks at, in camera space (core/camera.h: left-handed, right up view).
struct ShadowView {
    ViewFrustum frustum;              // near and far are the range that shadows are promised for, not the clip range
    glm::dvec3 towardsLight{0, 1, 0}; // unit length
    int imageHeight = 800;            // pixels of the real viewport
    WorldAnchor anchor;               // stabilised slices look at it, and `seen` lies in its axes
    std::vector<SeenPart> seen;       // all that the image shows, by depth; nothing: anything may be anywhere
};

/// How the frame's shadows are mapped.
struct ShadowOptions {
    Scheme scheme;                  // NearFace::Omit leaves a hole and is taken as Stretch here
    bool chosenOrientation = true;  // of whole slices about the light; off: the plain convention
    bool stabilized = false;        // texel-snapped, unwarped slices; scheme.faces and the warp are ignored
    double filterTexels = 0;        // width of the PCF kernel; 0 is a single lookup
    std::uint64_t texels = 4194304; // of all maps together, gutters included
    int minSide = 4;                // of a map, in texels without gutters
    int maxSide = 16384;            // of a map and of the texture
    std::uint64_t emptySlices = 0;  // bit i: slice i has no visible receiver and gets no map
};

/// What a map promises over its region: the perspective aliasing, with real sizes, viewport and kernel.
struct PromisedAliasing {
    double x = 0;       // along s
    double z = 0;       // along t, the paper's measure
    double sheared = 0; // along t, with the shear of the texel

    double worst() const { return x > z ? x : z; }
};

/// One map.
struct ShadowMapPartition {
    Region region;             // slice, face, vertices and planes in camera space
    WarpedMap map;             // light frame, kappa, and (s, t, depth) over the map without its gutters
    TexelRectangle rectangle;  // in the packed texture, gutters included
    ConvexVolume casterVolume; // camera space, grown by the lookup's reach
    DepthBias bias;
    PromisedAliasing promised;
    std::optional<StablePlace> stable; // of a stabilised slice's map

    /// (s, t, depth) over the map -> texture coordinates in the packed texture and depth.
    glm::dmat4 textureFromMap{1};
    /// Clip space to draw the casters with, viewport = `rectangle`: x and y fill it gutters included, z in [-w, w] with
    /// the smallest nearest to the light. w may be 0 or negative behind the warp's centre: clip homogeneously, and
    /// clamp depth per fragment.
    glm::dmat4 lightClipFromCamera{1};
    /// Texture coordinates in the packed texture (x, y in [0, 1] over all of it) and depth in [0, 1], times w.
    glm::dmat4 textureFromCamera{1};
    /// The same from clip space after the division: x, y = clip.xy / clip.w * textureScale + textureOffset. In single
    /// precision look up this way: centred on 0 the matrix is three times as exact.
    glm::dvec2 textureScale{1};
    glm::dvec2 textureOffset{0};
    /// For views so thin (depth ratio under 1.1 or half angle under a degree) that float positions must be relative to
    /// a point inside the slice: that point, in camera space; else 0. See relativeTo.
    glm::dvec3 origin{0};
};

/// Everything that a frame needs to know about its shadow maps.
struct ShadowMapSetup {
    static constexpr std::size_t kNoMap = static_cast<std::size_t>(-1);

    std::vector<ShadowMapPartition> maps;
    PartitionSelector selector;
    std::vector<std::size_t> mapOfPartition; // by ownerOf: an index into maps, or kNoMap for an empty slice
    int textureWidth = 0;
    int textureHeight = 0;
    int gutter = 1;
    OrientationState orientation;     // for the next frame
    std::vector<TexelDemand> demands; // by map; see texelsThatWouldDo

    /// The map that the lookup of `p` (camera space) reads, or kNoMap.
    std::size_t mapOf(const glm::dvec3& p) const { return mapOfPartition[ownerOf(selector, p)]; }

    /// The largest promise of all maps, on each axis.
    PromisedAliasing worst() const;
};

/// The shadow maps of `view` under `options`. Pure: what has to be continuous from frame to frame comes in through
/// `previous`, the orientation of the last frame's setup. Throws gnomon::Error for an invalid frustum, a light that is
/// not a direction, or a budget too small for the maps.
ShadowMapSetup shadowMapSetup(
    const ShadowView& view,
    const ShadowOptions& options,
    const std::optional<OrientationState>& previous = std::nullopt);

/// The texels that would let `setup` promise `aliasing`; 0 if no number would, or if it has no maps.
std::uint64_t texelsThatWouldDo(const ShadowMapSetup& setup, const ShadowOptions& options, double aliasing);

} // namespace gnomon::shadow
