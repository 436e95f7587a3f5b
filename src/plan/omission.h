// What a view does not call for, and why: for programs to compare; sentences are made where they are shown.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon::plan {

/// What a plan can go without.
enum class Effect : std::uint8_t {
    ShadowMaps,
    ExactShadows,
    MapOfSlice, // one slice's
    FacePartitions,
    ZPartitions,
    Warp,
    LogRows,     // of warped maps
    Orientation, // chosen about the light
    Stabilization,
    MapReuse,
    Filter,
    DepthClamp,
    PartitionCulling,
    ReceiverMasks,
    OcclusionCulling,
    LateCasters, // of exact shadows: what was still to be cast
    Penumbra,    // of the light's disc
    SkyLight,    // direction by direction
};

enum class OmissionReason : std::uint8_t {
    SwitchedOff,
    RayTraced,          // shadows are
    DecidedExactly,     // shadows are, point by point
    NothingInView,      //
    NothingFacesLight,  // of what is seen in the view, or in the slice
    NoCasterInReach,    // of a visible surface
    SlicesStabilized,   // which rules the effect out
    NotStabilized,      // which the effect needs
    LightGrazesFaces,   // every one of the view
    FacesGiveIt,        // the maps of faces follow their edges
    GainTooSmall,       // Omission::gain is less than 1 - kWorthwhile
    NoGain,             // the promise would not be lower
    BetterWithout,      // cheaper where the promise is kept, or lower by 1 - kWorthwhile
    OneSliceSuffices,   // it is the best at this promise
    NoCasterBeforeMaps, // all lie within their depths
    MapsComeFirst,      // the backend draws no image before them
    MapsAreKept,        // for views that see other receivers
    FewCasters,         // beside the pixels: finding out who receives light would cost more than they do
    BackendDrawsAll,    // whatever hides it
    BackendHasEvenRows, // and no others
    SlicesGiven,        // so many, and with them the scheme
    FewLayers,          // of clusters over a pixel
    ParallelSight,      // lines of sight are: nothing is nearer than anything else, and no perspective is to be matched
    AllAreDark,         // the visible points that face the light, before all casters were looked at
    NarrowPenumbrae,    // of at most Omission::pixels
    NoShadows,          // are asked for
    NoSun,              // the shading has none
    NothingHidesTheSky, // from what is seen
    FacesOfCube,        // about a lamp are its maps
};

/// Something that this view does not call for.
struct Omission {
    Effect effect = Effect::ShadowMaps;
    OmissionReason reason = OmissionReason::SwitchedOff;
    std::size_t slice = 0; // of MapOfSlice
    double gain = 0;       // of GainTooSmall: the share by which it would lower the promise
    double pixels = 0;     // of NarrowPenumbrae: a width

    bool operator==(const Omission&) const = default;
};

/// Where an end of the depth range comes from.
enum class DepthSource : std::uint8_t {
    Given,
    NearestSurface, // in view
    FarthestSurface,
    ModelBounds, // the hierarchy was not asked yet
    Floor,       // what is nearer is not promised for
    Held,        // from the frame before
    NothingInView,
};

} // namespace gnomon::plan
