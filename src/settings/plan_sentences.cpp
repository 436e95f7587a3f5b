#include "settings/plan_sentences.h"

#include "plan/hysteresis.h"
#include "settings/backend_choice.h"

#include <array>
#include <cstdio>

namespace gnomon::settings {

namespace {

using plan::Effect;
using plan::SkipReason;

std::string percent(double share, int decimals) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f%%", decimals, share * 100);
    return text.data();
}

std::string decimal(double value, int decimals) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

/// Returns by how many percent an effect must at least reduce the max perspective aliasing so that the plan uses it.
std::string minGain() {
    return percent(1 - plan::kWorthwhile, 0);
}

std::string whyGainIsTooSmall(const plan::SkippedEffect& skipped) {
    const char* const what = skipped.effect == Effect::Orientation ? "a roll about the light" : "at the same cost they";
    return std::string(what) + " would lower the aliasing bound by " + percent(skipped.gain, 1) + ", less than " +
           minGain();
}

const char* whyStabilized(Effect effect) {
    if (effect == Effect::Warp) return "stabilised slices are unwarped";
    if (effect == Effect::Orientation) return "stabilised slices keep the orientation of the world";
    return "stabilised slices have no face partitions";
}

/// Returns the sentence that explains why an effect is skipped, if the reason concerns penumbrae, the sky, evenly
/// spaced rows or point lights. The calling function handles all other reasons.
std::string otherReason(const plan::SkippedEffect& skipped) {
    switch (skipped.reason) {
    case SkipReason::NarrowPenumbrae:
        return "none in view is wider than " + decimal(skipped.pixels, 2) +
               " pixels across the beam: the light is a point";
    case SkipReason::NoShadows:
        return "shadows are switched off";
    case SkipReason::NoSun:
        return "the shading has no sun";
    case SkipReason::BackendHasEvenRows:
        return onlySoftware(&plan::Capabilities::unevenRows);
    case SkipReason::SlicesGiven:
        return "--z-partitions selects a scheme with evenly spaced rows";
    case SkipReason::NothingHidesTheSky:
        return "nothing hides the sky from a visible surface";
    case SkipReason::FacesOfCube:
        return "the maps of a point light are the faces of a cube around it";
    default:
        return "";
    }
}

} // namespace

std::string effectInWords(const plan::SkippedEffect& skipped) {
    switch (skipped.effect) {
    case Effect::ShadowMaps:
        return "shadow maps";
    case Effect::ExactShadows:
        return "exact shadows";
    case Effect::MapOfSlice:
        return "map of slice " + std::to_string(skipped.slice);
    case Effect::FacePartitions:
        return "face partitions";
    case Effect::ZPartitions:
        return "z-partitions";
    case Effect::Warp:
        return "warp";
    case Effect::LogRows:
        return "logarithmic rows";
    case Effect::Orientation:
        return "orientation";
    case Effect::Stabilization:
        return "stabilisation";
    case Effect::MapReuse:
        return "reuse of maps";
    case Effect::Filter:
        return "filter";
    case Effect::DepthClamp:
        return "depth clamp";
    case Effect::PartitionCulling:
        return "partition culling";
    case Effect::ReceiverMasks:
        return "receiver masks";
    case Effect::OcclusionCulling:
        return "occlusion culling";
    case Effect::LateCasters:
        return "late casters";
    case Effect::Penumbra:
        return "penumbrae";
    case Effect::SkyLight:
        return "the sky's shadows";
    }
    return "";
}

std::string reasonInWords(const plan::SkippedEffect& skipped) {
    switch (skipped.reason) {
    case SkipReason::SwitchedOff:
        if (skipped.effect == Effect::Filter)
            return "switched off; its kernel would widen the texels, and so raise the aliasing bound";
        return "switched off";
    case SkipReason::RayTraced:
        return "shadows are ray-traced";
    case SkipReason::ResolvedExactly:
        return "shadows are decided exactly, point by point";
    case SkipReason::NothingInView:
        return "nothing is in view";
    case SkipReason::NothingFacesLight:
        if (skipped.effect == Effect::MapOfSlice) return "no visible surface in it faces the light";
        return "no visible surface faces the light";
    case SkipReason::NoCasterInReach:
        return "no caster can reach a visible surface";
    case SkipReason::SlicesStabilized:
        return whyStabilized(skipped.effect);
    case SkipReason::NotStabilized:
        return "only stabilised maps stay in place while the camera moves";
    case SkipReason::LightGrazesFaces:
        return "the light grazes every face of the view";
    case SkipReason::FacesGiveIt:
        return "the maps of faces follow their edges";
    case SkipReason::GainTooSmall:
        return whyGainIsTooSmall(skipped);
    case SkipReason::NoGain:
        if (skipped.effect == Effect::Warp) return "it would not lower the aliasing bound under this light";
        return "at the same cost they would not lower the aliasing bound";
    case SkipReason::BetterWithout:
        return "without them the same aliasing bound costs less, or the bound is lower by " + minGain() + " at least";
    case SkipReason::OneSliceSuffices:
        return "a single slice is best for this aliasing bound";
    case SkipReason::NoCasterBeforeMaps:
        return "no caster is nearer to the light than its map begins";
    case SkipReason::MapsComeFirst:
        return onlySoftware(&plan::Capabilities::imageFirst);
    case SkipReason::MapsAreKept:
        return "stabilised maps are kept for views with other receivers";
    case SkipReason::FewCasters:
        return "there are few casters compared with the pixels to test";
    case SkipReason::BackendDrawsAll:
        return onlySoftware(&plan::Capabilities::occlusionCulling);
    case SkipReason::FewLayers:
        return "few clusters lie behind one another, so little is hidden";
    case SkipReason::ParallelSight:
        return "lines of sight are parallel: pixels have the same size at every depth, and so have texels without it";
    case SkipReason::AllAreDark:
        return "all visible surfaces that face the light were already dark";
    case SkipReason::NarrowPenumbrae:
    case SkipReason::NoShadows:
    case SkipReason::NoSun:
    case SkipReason::BackendHasEvenRows:
    case SkipReason::SlicesGiven:
    case SkipReason::NothingHidesTheSky:
    case SkipReason::FacesOfCube:
        break; // no default case: the compiler then warns of a new reason without words
    }
    return otherReason(skipped);
}

std::string reasonInWords(plan::ShadowReason reason) {
    using plan::ShadowReason;
    switch (reason) {
    case ShadowReason::Requested:
        return "they are requested";
    case ShadowReason::NoSun:
        return "the shading has no sun";
    case ShadowReason::MapsRequested:
        return "an option, an overlay or a validation of shadow maps is requested";
    case ShadowReason::FrameTime:
        return "exact shadows take too long for the target frame time";
    case ShadowReason::BackendHasMaps:
        return onlySoftware(&plan::Capabilities::exactShadows);
    case ShadowReason::BackendIsExact:
        return "the software backend draws exact shadows unless shadow maps are requested";
    }
    return "";
}

std::string shadowsInWords(const plan::FramePlan& plan) {
    return "shadows " + std::string(wordOf(plan::kShadowModes, plan.quality.shadows)) + ": " +
           reasonInWords(plan.shadowReason) + "\n";
}

std::string lightInWords(const plan::FramePlan& plan) {
    std::string text;
    if (plan.penumbra.directions > 1)
        text += "penumbrae of at most " + decimal(plan.penumbra.widestPixels, 2) +
                " pixels across the beam: " + std::to_string(plan.penumbra.directions) +
                " directions over the light's disc, for a lit share within " + decimal(plan.quality.lightError, 3) +
                "\n";
    if (const auto& soft = plan.penumbra.tiles)
        text += "in " + std::to_string(soft->count()) + " of " + std::to_string(soft->wanted.size()) +
                " tiles of 32 pixels; in the others none is wider than " + decimal(plan.penumbra.minPixels, 2) +
                " pixels, and frames beyond those of --samples are not drawn\n";
    if (plan.sky.directions > 0)
        text += "the sky's light from " + std::to_string(plan.sky.directions) + " directions, " +
                std::string(wordOf(plan::kSkyModels, plan.sky.model)) + "\n";
    return text;
}

std::string sourceInWords(plan::DepthSource source) {
    using plan::DepthSource;
    switch (source) {
    case DepthSource::Given:
        return "given";
    case DepthSource::NearestSurface:
        return "the nearest surface in view";
    case DepthSource::FarthestSurface:
        return "the farthest surface in view";
    case DepthSource::ModelBounds:
        return "the model's bounds";
    case DepthSource::Floor:
        return "the floor";
    case DepthSource::Held:
        return "kept from the previous frame";
    case DepthSource::NothingInView:
        return "nothing is in view";
    }
    return "";
}

} // namespace gnomon::settings
