// Sets up all shadow maps of a frame. The setup computes partitions, matrices, texels, caster volumes, depth bias and
// aliasing bounds from the view, the light and the scheme.
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

/// The camera and light for which shadow maps are set up, in camera space (core/camera.h: left-handed, x right, y up, z
/// along the view).
struct ShadowView {
    // The near and far end of this frustum are the depths in which aliasing has an upper bound. They do not clip
    // geometry.
    ViewFrustum frustum;
    std::optional<DepthSpan> shown;   // view depths of all receivers, if some of them are outside the frustum
    glm::dvec3 towardsLight{0, 1, 0}; // unit length
    int imageHeight = 800;            // pixels of the viewport
    WorldAnchor anchor;               // world position and axes of the camera, for stabilised slices and `seen`
    std::vector<VisibleSlab> seen;    // visible slabs, sorted by depth; empty: surfaces can be anywhere
};

/// The user's settings of the shadow maps.
struct ShadowOptions {
    Scheme scheme; // NearFace::Omit would leave a hole, so it is treated as Stretch
    // true: maps of whole slices are rotated about the light for the smallest storage factor S; false: the plain
    // orientation
    bool chosenOrientation = true;
    // true: unwarped slices whose maps snap to a texel grid of the world; scheme.faces and the warp are ignored
    bool stabilized = false;
    double filterTexels = 0;        // width of the PCF kernel in texels; 0: no filter
    std::uint64_t texels = 4194304; // total of all maps, borders included
    int minSide = 4;                // min side of a map, in texels without borders
    int maxSide = 16384;            // max side of a map and of the texture
    std::uint64_t emptySlices = 0;  // bit i: slice i has no visible receiver and needs no map
};

/// All shadow maps of a frame, and the rule that assigns each point to one of them.
struct ShadowMapSetup {
    static constexpr std::size_t kNoMap = static_cast<std::size_t>(-1);

    std::vector<ShadowMap> maps;
    PartitionSelector selector;
    /// The index in `maps` for each partition (result of partitionIndex), or kNoMap for a slice without receivers.
    std::vector<std::size_t> mapOfPartition;
    int textureWidth = 0;
    int textureHeight = 0;
    OrientationState orientation;     // rotation of the maps about the light, for the next frame
    std::vector<TexelDemand> demands; // texels for an aliasing of 1, one entry per map; requiredTexels uses them

    /// Returns the index of the shadow map that point `p` (camera space) looks up, or kNoMap.
    std::size_t mapOf(const glm::dvec3& p) const { return mapOfPartition[partitionIndex(selector, p)]; }

    /// Returns the largest upper bound of perspective aliasing over all shadow maps, per axis.
    AliasingBound worst() const;
};

/// Returns the shadow maps of `view` with `options`. This is a pure function. `previous` contains the rotation of the
/// maps about the light in the previous frame, so that the rotation changes continuously. Throws gnomon::Error for an
/// invalid frustum, for a light vector without unit length, or if the texel budget is too small for the maps.
ShadowMapSetup shadowMapSetup(
    const ShadowView& view,
    const ShadowOptions& options,
    const std::optional<OrientationState>& previous = std::nullopt);

/// Returns the limits in `options` for the distribution of texels over the maps.
TexelLimits limitsOf(const ShadowOptions& options);

/// Returns the number of texels that the maps of `setup` require for a max perspective aliasing of `aliasing`. Returns
/// 0 if no number suffices or if the setup has no maps.
std::uint64_t requiredTexels(const ShadowMapSetup& setup, const ShadowOptions& options, double aliasing);

} // namespace gnomon::shadow
