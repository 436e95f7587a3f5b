// Lists the effects that a plan skips, with the reasons as enum values. Other code converts these values to sentences
// for the user.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon::plan {

/// The effects and optimisations that a plan can omit from a frame.
enum class Effect : std::uint8_t {
    ShadowMaps,
    ExactShadows,
    MapOfSlice, // the map of one slice
    FacePartitions,
    ZPartitions,
    Warp,
    LogRows,     // logarithmic rows of warped maps
    Orientation, // rotation of a map about the light
    Stabilization,
    MapReuse,
    Filter,
    DepthClamp,
    PartitionCulling,
    ReceiverMasks,
    OcclusionCulling,
    LateCasters, // test of the remaining casters of exact shadows
    Penumbra,    // shadows from several directions of the light's disc
    SkyLight,    // light from several directions of the sky
};

enum class SkipReason : std::uint8_t {
    SwitchedOff,
    RayTraced,         // rays compute the shadows
    ResolvedExactly,   // exact shadows are computed per visible point
    NothingInView,     // no surface is in view
    NothingFacesLight, // no visible surface, in the view or in the slice, faces the light
    NoCasterInReach,   // no caster can shadow a visible surface
    SlicesStabilized,  // stabilised slices exclude the effect
    NotStabilized,     // the effect is only possible with stabilised slices
    LightGrazesFaces,  // the light grazes every face of the frustum
    FacesGiveIt,       // face partitions replace the effect: their maps already follow the edges of the faces
    // the effect would lower the aliasing bound by SkippedEffect::gain, which is less than 1 - kWorthwhile
    GainTooSmall,
    NoGain, // the effect would not lower the aliasing bound
    // without the effect, the scheme costs less, or its aliasing bound is higher by less than kWorthwhile permits
    BetterWithout,
    OneSliceSuffices,   // one slice is the best scheme for this aliasing bound
    NoCasterBeforeMaps, // no caster is nearer to the light than the depth range of its map
    MapsComeFirst,      // the backend draws the maps before the image
    MapsAreKept,        // later frames, which see other receivers, reuse the maps
    // there are so few caster triangles per pixel that the receiver masks would cost more than the triangles
    FewCasters,
    BackendDrawsAll,    // the backend also draws hidden clusters
    BackendHasEvenRows, // the backend does not draw logarithmic rows
    SlicesGiven,        // the user gave the number of slices, which fixes the scheme
    FewLayers,          // too few clusters overlap per pixel
    // the projection is parallel: pixels have the same size at all depths, so there is no perspective aliasing
    ParallelSight,
    // all visible points that face the light were in shadow before all casters were tested
    AllAreDark,
    NarrowPenumbrae,    // all penumbrae are narrower than SkippedEffect::pixels
    NoShadows,          // the user requested no shadows
    NoSun,              // the shading has no sun
    NothingHidesTheSky, // no geometry hides the sky from a visible surface
    FacesOfCube,        // the maps of a lamp are the faces of a cube
};

/// An effect that a plan skips, and the reason.
struct SkippedEffect {
    Effect effect = Effect::ShadowMaps;
    SkipReason reason = SkipReason::SwitchedOff;
    std::size_t slice = 0; // for MapOfSlice
    double gain = 0;       // for GainTooSmall: the share by which the effect would lower the aliasing bound
    double pixels = 0;     // for NarrowPenumbrae: every penumbra is narrower than this width

    bool operator==(const SkippedEffect&) const = default;
};

/// The origin of the near or far end of a frame's depth range.
enum class DepthSource : std::uint8_t {
    Given,
    NearestSurface, // the nearest surface in view
    FarthestSurface,
    ModelBounds, // an end of the model's bounds, because the hierarchy has not been traversed yet
    Floor,       // the smallest permitted near depth; nearer surfaces have no aliasing bound
    Held,        // the value of the previous frame (hysteresis)
    NothingInView,
};

} // namespace gnomon::plan
