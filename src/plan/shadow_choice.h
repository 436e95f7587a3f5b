// Which kind of shadows a frame gets where that is left open, and why: decided by counts and by what each of them has
// been measured to take, never by a clock.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::plan {

/// Exact decides each visible point in integers; Rays asks a ray tracer; Maps looks shadow maps up; Auto is Exact or
/// Maps, whichever is predicted to cost less.
enum class ShadowMode : std::uint8_t { Off, Maps, Exact, Rays, Auto };
inline constexpr std::array kShadowModes = {
    Word<ShadowMode>{ShadowMode::Off, "off"},
    Word<ShadowMode>{ShadowMode::Maps, "maps"},
    Word<ShadowMode>{ShadowMode::Exact, "exact"},
    Word<ShadowMode>{ShadowMode::Rays, "rays"},
    Word<ShadowMode>{ShadowMode::Auto, "auto"},
};

/// Why a frame's shadows are of the mode that they are.
enum class ShadowReason : std::uint8_t {
    AskedFor,         // by its name
    MapsAskedFor,     // by an option, an overlay or a proof of maps
    NoSun,            // the shading has none
    ExecutorHasMaps,  // and cannot decide exactly
    ExactCostsNoMore, // than maps, as predicted
    MapsCostLess,     // than exact shadows, as predicted
    PointLight,       // which is exact unless maps or rays are asked for
    Held,             // from the frame before: the other mode is not cheaper by enough, or not for long enough
};

/// What exact shadows of a view take, and maps in their place. Predicted before anything is drawn.
struct ExactWork {
    double samples = 0;         // pixels that face the light
    double casterTriangles = 0; // of all clusters that can cast
    double castTriangles = 0;   // that the receiver mask keeps when it is their turn
    double sampleTests = 0;     // pairs of a triangle and a sample
    double keptTriangles = 0;   // that four maps in 2048x2048 texels would draw, of the clusters their masks keep
    double mapFragments = 0;    // texels that these cover, summed
};

/// What the shadows of a frame are predicted to take, in nanoseconds of the machine that the constants come from: only
/// which one is larger means anything.
struct ShadowCosts {
    double exact = 0;
    double maps = 0;
};

/// The costs of `work`, and those of four maps in 2048x2048 texels for the same view.
ShadowCosts shadowCosts(const ExactWork& work);

/// The mode of the frame before, if its costs are looked at.
struct ModeMemory {
    bool isExact = false;
    int framesDominated = 0; // for how many frames in a row, that one included, the other mode has dominated it
    int framesUnasked = 0;   // for how many frames the costs have not been looked at
    bool isAskedFor = false; // exact shadows by their name: looked at for the log alone
};

/// The mode of a frame, why, and what the next frame is to be told.
struct ShadowChoice {
    ShadowMode mode = ShadowMode::Maps;
    ShadowReason reason = ShadowReason::AskedFor;
    std::optional<ModeMemory> memory; // nothing where the mode was asked for
};

/// The memory of a frame behind `before` whose costs need not be looked at: they are in every kFramesBetweenCosts-th
/// frame, and in each while another mode dominates. Nothing where costs are called for.
std::optional<ModeMemory> withoutCosts(const std::optional<ModeMemory>& before);

/// The choice by `costs`: exact shadows where they cost no more; behind a frame with the other mode only if that is
/// dominated (plan/hysteresis.h) for long enough.
ShadowChoice choiceByCosts(const ShadowCosts& costs, const std::optional<ModeMemory>& before);

} // namespace gnomon::plan
