#include "settings/plan_sentences.h"

#include "plan/hysteresis.h"
#include "settings/backend_choice.h"

#include <array>
#include <cstdio>

namespace gnomon::settings {

namespace {

using plan::Effect;
using plan::OmissionReason;

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

/// Returns the min reduction of the aliasing bound for which the plan uses an effect, as a percentage.
std::string leastGain() {
    return percent(1 - plan::kWorthwhile, 0);
}

std::string whyGainIsTooSmall(const plan::Omission& omission) {
    const char* const what =
        omission.effect == Effect::Orientation ? "a roll about the light" : "at the same cost they";
    return std::string(what) + " would lower the promise by " + percent(omission.gain, 1) + ", less than " +
           leastGain();
}

const char* whyStabilized(Effect effect) {
    if (effect == Effect::Warp) return "stabilised slices are unwarped";
    if (effect == Effect::Orientation) return "stabilised slices keep that of the world";
    return "stabilised slices are whole";
}

/// Returns the words for reasons about penumbrae, the sky, even rows and point lights. The calling function handles all
/// other reasons.
std::string otherReason(const plan::Omission& omission) {
    switch (omission.reason) {
    case OmissionReason::NarrowPenumbrae:
        return "none in view is wider than " + decimal(omission.pixels, 2) +
               " pixels across the beam: the light is a point";
    case OmissionReason::NoShadows:
        return "shadows are switched off";
    case OmissionReason::NoSun:
        return "the shading has no sun";
    case OmissionReason::BackendHasEvenRows:
        return onlySoftware(&plan::Capabilities::unevenRows);
    case OmissionReason::SlicesGiven:
        return "--z-partitions gives the slices, and with them a scheme of even rows";
    case OmissionReason::NothingHidesTheSky:
        return "nothing stands between what is seen and the sky";
    case OmissionReason::FacesOfCube:
        return "a lamp's maps are the faces of a cube about it";
    default:
        return "";
    }
}

} // namespace

std::string effectInWords(const plan::Omission& omission) {
    switch (omission.effect) {
    case Effect::ShadowMaps:
        return "shadow maps";
    case Effect::ExactShadows:
        return "exact shadows";
    case Effect::MapOfSlice:
        return "map of slice " + std::to_string(omission.slice);
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
        return "the casters that were left";
    case Effect::Penumbra:
        return "penumbrae";
    case Effect::SkyLight:
        return "the sky's shadows";
    }
    return "";
}

std::string reasonInWords(const plan::Omission& omission) {
    switch (omission.reason) {
    case OmissionReason::SwitchedOff:
        if (omission.effect == Effect::Filter)
            return "switched off; its kernel would widen the texels, and so raise the promise";
        return "switched off";
    case OmissionReason::RayTraced:
        return "shadows are ray-traced";
    case OmissionReason::DecidedExactly:
        return "shadows are decided exactly, point by point";
    case OmissionReason::NothingInView:
        return "nothing is in view";
    case OmissionReason::NothingFacesLight:
        if (omission.effect == Effect::MapOfSlice) return "nothing that is seen in it faces the light";
        return "no visible surface faces the light";
    case OmissionReason::NoCasterInReach:
        return "no caster can reach a visible surface";
    case OmissionReason::SlicesStabilized:
        return whyStabilized(omission.effect);
    case OmissionReason::NotStabilized:
        return "only stabilised ones stay where they are while the camera moves";
    case OmissionReason::LightGrazesFaces:
        return "the light grazes every face of the view";
    case OmissionReason::FacesGiveIt:
        return "the maps of faces follow their edges";
    case OmissionReason::GainTooSmall:
        return whyGainIsTooSmall(omission);
    case OmissionReason::NoGain:
        if (omission.effect == Effect::Warp) return "it would not lower the promise under this light";
        return "at the same cost they would not lower the promise";
    case OmissionReason::BetterWithout:
        return "without them the promise costs less, or is lower by " + leastGain() + " at least";
    case OmissionReason::OneSliceSuffices:
        return "a single slice is best at this promise";
    case OmissionReason::NoCasterBeforeMaps:
        return "no caster is nearer to the light than its map begins";
    case OmissionReason::MapsComeFirst:
        return onlySoftware(&plan::Capabilities::imageFirst);
    case OmissionReason::MapsAreKept:
        return "stabilised maps are kept for views with other receivers";
    case OmissionReason::FewCasters:
        return "there are few casters beside the pixels that would have to be asked";
    case OmissionReason::BackendDrawsAll:
        return onlySoftware(&plan::Capabilities::occlusionCulling);
    case OmissionReason::FewLayers:
        return "few clusters lie behind one another, so little is hidden";
    case OmissionReason::ParallelSight:
        return "lines of sight are parallel: pixels are alike at every depth, and so are texels without it";
    case OmissionReason::AllAreDark:
        return "all that is seen and faces the light was dark before they were looked at";
    case OmissionReason::NarrowPenumbrae:
    case OmissionReason::NoShadows:
    case OmissionReason::NoSun:
    case OmissionReason::BackendHasEvenRows:
    case OmissionReason::SlicesGiven:
    case OmissionReason::NothingHidesTheSky:
    case OmissionReason::FacesOfCube:
        break; // no default case: the compiler then warns of a new reason without words
    }
    return otherReason(omission);
}

std::string reasonInWords(plan::ShadowReason reason) {
    using plan::ShadowReason;
    switch (reason) {
    case ShadowReason::Requested:
        return "they are requested";
    case ShadowReason::NoSun:
        return "the shading has no sun";
    case ShadowReason::MapsRequested:
        return "an option, an overlay or a proof of shadow maps is requested";
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
                " tiles of 32 pixels; in the others none is wider than " + decimal(plan.penumbra.leastPixels, 2) +
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
        return "held from the frame before";
    case DepthSource::NothingInView:
        return "nothing is in view";
    }
    return "";
}

} // namespace gnomon::settings
