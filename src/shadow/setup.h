// The shadow maps of one frame as one value: from view, light and scheme to partitions with matrices, texels, caster
// volumes, bias and the aliasing that they promise.
#pragma once

#include "shadow/caster_volume.h"
#include "shadow/scheme.h"
#include "shadow/shadow_map.h"
#include "shadow/texels/texel_budget.h"
#include "shadow/warp/orientation.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::shadow {

/// What a frame looks at, in camera space (core/camera.h: left-handed, right up view).
struct ShadowView {
    ViewFrustum frustum;              // near and far are the range that shadows are promised for, not the clip range
    std::optional<DepthSpan> shown;   // view depths of all that is to have shadows, if some lies beyond the frustum
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

/// Everything that a frame needs to know about its shadow maps.
struct ShadowMapSetup {
    static constexpr std::size_t kNoMap = static_cast<std::size_t>(-1);

    std::vector<ShadowMap> maps;
    PartitionSelector selector;
    std::vector<std::size_t> mapOfPartition; // by ownerOf: an index into maps, or kNoMap for an empty slice
    int textureWidth = 0;
    int textureHeight = 0;
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

/// What the split of texels has to keep to under `options`.
TexelLimits limitsOf(const ShadowOptions& options);

/// The texels that would let `setup` promise `aliasing`; 0 if no number would, or if it has no maps.
std::uint64_t texelsThatWouldDo(const ShadowMapSetup& setup, const ShadowOptions& options, double aliasing);

} // namespace gnomon::shadow
