// A frame as a value: what will be drawn, with which volumes, matrices and texels, what it promises, and why everything
// else is left out. Made without GL, files or a clock; backends only carry it out.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "core/depth_span.h"
#include "core/integer_light.h"
#include "plan/capabilities.h"
#include "plan/light_sampling.h"
#include "plan/look.h"
#include "plan/omission.h"
#include "plan/shadow_mode.h"
#include "shadow/shadow_map.h"
#include "shadow/warp/warp.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::plan {

/// A lamp: light from one point, that falls off with the square of the distance.
struct PointLight {
    glm::dvec3 at{0}; // world space, on the model's grid
    double reach = 1; // world units, above 0: so far away it is as bright as the sun

    bool operator==(const PointLight&) const = default;
};

/// What is looked at, from where, towards which light.
struct View {
    Camera camera;
    int width = 800; // pixels, at least 1
    int height = 800;
    glm::dvec3 towardsLight{0.4, 1, 0.3}; // world space, any length above 0; light() is drawn by
    glm::dvec3 up{0, 1, 0};               // towards the sky, likewise of any length above 0
    std::optional<PointLight> pointLight; // in place of what towardsLight says, which then is roughly where it is
    double sunAngleRadians = 0;           // across the disc of the light; 0: a point
    std::optional<double> eyeMovedBack;   // by distantView, world units
    std::vector<Plane> sections;          // world space; only what lies on the inner side of all of them is seen
    bool cutsCasters = true;              // nor does anything else cast shadows

    /// The light that is drawn by: rounded here, and nowhere else.
    IntegerLight light() const { return roundedLight(towardsLight); }

    double aspect() const { return static_cast<double>(width) / height; }

    double tanHalfY() const { return std::tan(camera.fovYRadians / 2); }

    double tanHalfX() const { return aspect() * tanHalfY(); }

    bool operator==(const View&) const = default;
};

/// How the cells of exact shadows lie: as the texels of one map or of four slices, and of a warp or not. Changes no
/// picture.
enum class CellScheme : std::uint8_t { WarpedMap, Map, WarpedSlices, Slices };
inline constexpr std::array kCellSchemes = {
    Word<CellScheme>{CellScheme::WarpedMap, "map+w"},
    Word<CellScheme>{CellScheme::Map, "map"},
    Word<CellScheme>{CellScheme::WarpedSlices, "zp4+w"},
    Word<CellScheme>{CellScheme::Slices, "zp4"},
};

enum class Choice : std::uint8_t { Off, On, Auto };
inline constexpr std::array kChoices = {
    Word<Choice>{Choice::Off, "off"},
    Word<Choice>{Choice::On, "on"},
    Word<Choice>{Choice::Auto, "auto"},
};

/// What a map draws: Off all there is, On what can throw a shadow into its partition, Receivers of these what can
/// change a pixel of the image. Auto is one of the last two.
enum class CasterCulling : std::uint8_t { Auto, On, Off, Receivers };
inline constexpr std::array kCasterCullings = {
    Word<CasterCulling>{CasterCulling::Auto, "auto"},
    Word<CasterCulling>{CasterCulling::On, "on"},
    Word<CasterCulling>{CasterCulling::Off, "off"},
    Word<CasterCulling>{CasterCulling::Receivers, "receivers"},
};

/// What the user asked for; the names are those of the command line.
struct Quality {
    ShadowMode shadows = ShadowMode::Maps;   // Auto: decideShadows returns the kind
    std::optional<ShadowReason> mapsBecause; // the reason why Auto means maps; nothing: the backend decides
    shadow::Warp warp;
    std::optional<int> zPartitions = 4; // nothing: auto
    double splitLambda = 1;
    Choice facePartitions = Choice::Off;
    int shadowTexelsWidth = 2048; // a count: all maps together, gutters included
    int shadowTexelsHeight = 2048;
    double maxAliasing = 4;
    int filter = 0; // PCF kernel in texels
    CasterCulling cullCasters = CasterCulling::Auto;
    bool stabilize = false;
    CellScheme cellScheme = CellScheme::WarpedMap; // no option: only a report compares them
    std::optional<double> near;                    // nothing: auto
    std::optional<double> far;
    std::optional<double> nearFloor; // nothing: far / 10000
    double errorPixels = 1;
    std::optional<std::uint64_t> maxTriangles;
    Choice occlusion = Choice::Auto; // the image is drawn without what it hides; Auto: where that pays
    Look look;
    double lightError = 0.05; // of the share of the light's disc that reaches a point, at most
    SkyLight sky;

    bool operator==(const Quality&) const = default;
};

/// What is known of the scene in this view before its geometry was asked, and after.
struct SceneFacts {
    Box bounds; // world space

    /// Least and largest view depth of anything drawn in the frustum; nothing before the hierarchy was asked.
    struct Visible {
        double nearest = 0;
        double farthest = 0;
        bool anything = false;
    };

    std::optional<Visible> visible;

    /// Some clusters that could cast shadows into the view, together.
    struct CasterBlock {
        Box box; // world axes, relative to the eye
        std::uint64_t triangles = 0;
    };

    /// What the light finds in the view.
    struct Light {
        std::vector<DepthSpan> lit;         // depths of visible surfaces that face it, apart and in order
        bool canBeShadowed = true;          // something may stand between it and one of them
        std::vector<CasterBlock> casters;   // all that can throw a shadow into the view
        std::vector<shadow::SeenPart> seen; // all that is in view, by depth
    };

    std::optional<Light> light;
    bool isTurnedFromLight = false; // all that is in view, for sure
};

/// One shadow map and how this frame draws it.
struct ShadowPass {
    shadow::ShadowMap map;
    bool clampsDepth = true;              // a caster may be nearer to the light than the map begins
    std::uint64_t estimatedTriangles = 0; // of its casters
    bool isReused = false;                // the frame before left just these texels: they are not drawn again
};

/// The plan of a frame.
struct FramePlan {
    View view;
    Quality quality;      // its shadows are the drawn ones, never Auto
    Capabilities backend; // of the backend that the plan is for
    ShadowReason shadowReason = ShadowReason::Requested;
    CameraBasis basis;
    IntegerLight light;               // the view's
    glm::dvec3 towardsLight{0, 1, 0}; // the same: unit, camera space
    double near = 0;                  // the range that shadows are promised for
    double far = 0;
    DepthSpan shown; // [near, far] and what is in view beyond it, whose shadows are drawn and not promised
    DepthSource nearFrom = DepthSource::Given;
    DepthSource farFrom = DepthSource::Given;
    double lightAngleRadians = 0;
    std::vector<double> splits; // of the slices; empty without maps
    bool hasFaces = false;
    shadow::PartitionSelector selector; // which partition owns a point
    std::vector<int> passOfPartition;   // by the selector's index, of a lamp by shadow::cubeFaceOf; -1: no map
    std::vector<ShadowPass> passes;
    std::vector<shadow::ShadowMap> cellMaps; // of exact shadows: their matrices lay out the cells of the samples
    shadow::Aliasing promised;               // the largest over all passes
    double storageFactor = 0;
    CasterCulling casterCulling = CasterCulling::On; // never Auto
    bool promiseKept = true;                         // only `auto` promises anything: at most quality.maxAliasing
    std::uint64_t texelsThatWouldDo = 0; // for that; with several schemes to choose from the least of them; 0: none
    std::uint64_t cost = 0;              // counted: estimated caster triangles + texels / 16
    Penumbra penumbra;                   // of pictures that are the mean of frames
    SkyLight sky;                        // likewise
    std::vector<Omission> omitted;
    bool skipsHidden = false; // the image is drawn without what it hides: the same picture
    int textureWidth = 0;     // of the depth texture; 0 without maps
    int textureHeight = 0;
};

/// `depth`, from the eye that `plan` is made for, as it is from the eye that was asked for.
inline double depthFromAskedEye(const FramePlan& plan, double depth) {
    return depth - plan.view.eyeMovedBack.value_or(0);
}

/// The word for the scheme in the log: "off", "rays", "map", "zp4", "fp", "fp+zp4", with "+w" where a map is warped,
/// "+log" where its rows are logarithmic; "cube" of a lamp.
std::string schemeName(const FramePlan& plan);

} // namespace gnomon::plan
