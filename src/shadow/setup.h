// The setup of all shadow maps of a frame. It turns view, light and scheme into partitions with matrices, texels,
// caster volumes, depth bias and aliasing bounds.
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

/// The view that needs shadows, in camera space (core/camera.h: left-handed, x right, y up, z along the view).
struct ShadowView {
    ViewFrustum frustum;              // near and far are the depth range of the aliasing bound, not the clip range
    std::optional<DepthSpan> shown;   // view depths of all receivers, if some lie outside the frustum's depths
    glm::dvec3 towardsLight{0, 1, 0}; // unit length
    int imageHeight = 800;            // pixels of the real viewport
    WorldAnchor anchor;               // world position and axes of the camera, for stabilised slices and `seen`
    std::vector<VisibleSlab> seen;    // the visible slabs, by depth; empty: surfaces can be anywhere
};

/// The settings of the shadow maps.
struct ShadowOptions {
    Scheme scheme;                  // NearFace::Omit would leave a hole and means Stretch here
    bool chosenOrientation = true;  // whole slices use the rotation with the smallest S; false: the plain convention
    bool stabilized = false;        // unwarped slices that snap to texels; ignores scheme.faces and the warp
    double filterTexels = 0;        // width of the PCF kernel; 0 is a single lookup
    std::uint64_t texels = 4194304; // of all maps together, borders included
    int minSide = 4;                // min side of a map, in texels without borders
    int maxSide = 16384;            // max side of a map and of the texture
    std::uint64_t emptySlices = 0;  // bit i: slice i has no visible receiver and gets no map
};

/// All shadow maps of a frame, and the selector that assigns each point to one of them.
struct ShadowMapSetup {
    static constexpr std::size_t kNoMap = static_cast<std::size_t>(-1);

    std::vector<ShadowMap> maps;
    PartitionSelector selector;
    /// By the result of partitionIndex: an index into maps, or kNoMap for an empty slice.
    std::vector<std::size_t> mapOfPartition;
    int textureWidth = 0;
    int textureHeight = 0;
    OrientationState orientation;     // for the next frame
    std::vector<TexelDemand> demands; // by map; requiredTexels uses them

    /// Returns the index of the map that a lookup at `p` (camera space) reads, or kNoMap.
    std::size_t mapOf(const glm::dvec3& p) const { return mapOfPartition[partitionIndex(selector, p)]; }

    /// Returns the largest aliasing bound of all maps, separately per axis.
    AliasingBound worst() const;
};

/// Returns the shadow maps of `view` with `options`. This is a pure function: `previous`, the orientation from the
/// setup of the last frame, keeps the orientation continuous between frames. Throws gnomon::Error for an invalid
/// frustum, for a light vector without unit length, or if the texel budget is too small for the maps.
ShadowMapSetup shadowMapSetup(
    const ShadowView& view,
    const ShadowOptions& options,
    const std::optional<OrientationState>& previous = std::nullopt);

/// Returns the limits that `options` set for the distribution of texels over the maps.
TexelLimits limitsOf(const ShadowOptions& options);

/// Returns the number of texels that `setup` requires for an aliasing bound of `aliasing`. Returns 0 if no number
/// suffices or if the setup has no maps.
std::uint64_t requiredTexels(const ShadowMapSetup& setup, const ShadowOptions& options, double aliasing);

} // namespace gnomon::shadow
