// What a plan leaves out, in the words that commands and window show.
#include "settings/plan_sentences.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace gnomon::settings {
namespace {

using plan::Effect;
using plan::SkippedEffect;
using plan::SkipReason;

TEST(PlanSentences, NameEffectAndReason) {
    struct Row {
        SkippedEffect skipped;
        const char* effect;
        const char* reason;
    };

    using Reason = SkipReason;
    const std::vector<Row> table{
        {{Effect::ShadowMaps, Reason::SwitchedOff}, "shadow maps", "switched off"},
        {{Effect::ShadowMaps, Reason::RayTraced}, "shadow maps", "shadows are ray-traced"},
        {{Effect::ShadowMaps, Reason::NothingInView}, "shadow maps", "nothing is in view"},
        {{Effect::ShadowMaps, Reason::NothingFacesLight}, "shadow maps", "no visible surface faces the light"},
        {{Effect::ShadowMaps, Reason::NoCasterInReach}, "shadow maps", "no caster can reach a visible surface"},
        {{Effect::MapOfSlice, Reason::NothingFacesLight, 3},
         "map of slice 3",
         "no visible surface in it faces the light"},
        {{Effect::FacePartitions, Reason::SlicesStabilized},
         "face partitions",
         "stabilised slices have no face partitions"},
        {{Effect::FacePartitions, Reason::LightGrazesFaces},
         "face partitions",
         "the light grazes every face of the view"},
        {{Effect::FacePartitions, Reason::GainTooSmall, 0, 0.0312},
         "face partitions",
         "at the same cost they would lower the aliasing bound by 3.1%, less than 5%"},
        {{Effect::FacePartitions, Reason::NoGain},
         "face partitions",
         "at the same cost they would not lower the aliasing bound"},
        {{Effect::FacePartitions, Reason::BetterWithout},
         "face partitions",
         "without them the same aliasing bound costs less, or the bound is lower by 5% at least"},
        {{Effect::ZPartitions, Reason::OneSliceSuffices},
         "z-partitions",
         "a single slice is best for this aliasing bound"},
        {{Effect::Warp, Reason::SlicesStabilized}, "warp", "stabilised slices are unwarped"},
        {{Effect::Warp, Reason::NoGain}, "warp", "it would not lower the aliasing bound under this light"},
        {{Effect::LogRows, Reason::BackendHasEvenRows},
         "logarithmic rows",
         "only the software backend draws logarithmic maps"},
        {{Effect::LogRows, Reason::SlicesGiven},
         "logarithmic rows",
         "--z-partitions selects a scheme with evenly spaced rows"},
        {{Effect::Orientation, Reason::SlicesStabilized},
         "orientation",
         "stabilised slices keep the orientation of the world"},
        {{Effect::Orientation, Reason::FacesGiveIt}, "orientation", "the maps of faces follow their edges"},
        {{Effect::Orientation, Reason::GainTooSmall, 0, 0.04},
         "orientation",
         "a roll about the light would lower the aliasing bound by 4.0%, less than 5%"},
        {{Effect::Stabilization, Reason::SwitchedOff}, "stabilisation", "switched off"},
        {{Effect::MapReuse, Reason::NotStabilized},
         "reuse of maps",
         "only stabilised maps stay in place while the camera moves"},
        {{Effect::Filter, Reason::SwitchedOff},
         "filter",
         "switched off; its kernel would widen the texels, and so raise the aliasing bound"},
        {{Effect::DepthClamp, Reason::NoCasterBeforeMaps},
         "depth clamp",
         "no caster is nearer to the light than its map begins"},
        {{Effect::PartitionCulling, Reason::SwitchedOff}, "partition culling", "switched off"},
        {{Effect::LateCasters, Reason::AllAreDark},
         "late casters",
         "all visible surfaces that face the light were already dark"},
        {{Effect::OcclusionCulling, Reason::FewLayers},
         "occlusion culling",
         "few clusters lie behind one another, so little is hidden"},
        {{Effect::OcclusionCulling, Reason::BackendDrawsAll},
         "occlusion culling",
         "only the software backend skips hidden clusters"},
        {{Effect::Penumbra, Reason::NarrowPenumbrae, 0, 0, 0.4712},
         "penumbrae",
         "none in view is wider than 0.47 pixels across the beam: the light is a point"},
        {{Effect::Penumbra, Reason::NoShadows}, "penumbrae", "shadows are switched off"},
        {{Effect::SkyLight, Reason::NoSun}, "the sky's shadows", "the shading has no sun"},
        {{Effect::SkyLight, Reason::NothingHidesTheSky},
         "the sky's shadows",
         "nothing hides the sky from a visible surface"},
    };
    for (const Row& row : table) {
        EXPECT_EQ(effectInWords(row.skipped), row.effect);
        EXPECT_EQ(reasonInWords(row.skipped), row.reason);
    }
}

TEST(PlanSentences, SayWhichShadowsAndWhy) {
    using plan::ShadowReason;
    std::set<std::string> words;
    for (const ShadowReason reason :
         {ShadowReason::Requested,
          ShadowReason::NoSun,
          ShadowReason::MapsRequested,
          ShadowReason::FrameTime,
          ShadowReason::BackendHasMaps,
          ShadowReason::BackendIsExact})
        words.insert(reasonInWords(reason));
    EXPECT_EQ(words.size(), 6U);
    EXPECT_EQ(words.count(""), 0U);
    plan::FramePlan plan;
    plan.quality.shadows = plan::ShadowMode::Exact;
    EXPECT_EQ(shadowsInWords(plan), "shadows exact: they are requested\n");
    const SkippedEffect nothing{Effect::ExactShadows, SkipReason::NothingFacesLight};
    EXPECT_EQ(
        effectInWords(nothing) + ": " + reasonInWords(nothing), "exact shadows: no visible surface faces the light");
}

TEST(PlanSentences, SayFromHowManyDirectionsLightComes) {
    plan::FramePlan plan;
    EXPECT_EQ(lightInWords(plan), "");
    plan.penumbra = {3.125, 0.47, 80};
    plan.sky = {64, plan::SkyModel::Overcast};
    EXPECT_EQ(
        lightInWords(plan),
        "penumbrae of at most 3.12 pixels across the beam: 80 directions over the light's disc, for a lit share within "
        "0.050\nthe sky's light from 64 directions, overcast\n");
    plan.sky = {};
    const shadow::TileMask soft{{64, 64}, {true, false, true, true}};
    plan.penumbra.tiles = std::make_shared<const shadow::TileMask>(soft);
    const std::string words = lightInWords(plan);
    EXPECT_EQ(
        words.substr(words.find('\n') + 1),
        "in 3 of 4 tiles of 32 pixels; in the others none is wider than 0.47 pixels, and frames beyond those of "
        "--samples are not drawn\n");
}

TEST(PlanSentences, NameEverySourceOfADepthApart) {
    using plan::DepthSource;
    std::set<std::string> words;
    for (const DepthSource source :
         {DepthSource::Given,
          DepthSource::NearestSurface,
          DepthSource::FarthestSurface,
          DepthSource::ModelBounds,
          DepthSource::Floor,
          DepthSource::Held,
          DepthSource::NothingInView})
        words.insert(sourceInWords(source));
    EXPECT_EQ(words.size(), 7U);
    EXPECT_EQ(words.count(""), 0U);
    EXPECT_EQ(sourceInWords(DepthSource::NearestSurface), "the nearest surface in view");
}

} // namespace
} // namespace gnomon::settings
