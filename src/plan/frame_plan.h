// A plan describes a frame completely: its shadow maps and passes with volumes, matrices, texels and aliasing bounds,
// and the reason for each skipped effect. Planning uses no GL, files or clock. A backend draws the plan.
#pragma once

#include "core/camera.h"
#include "core/convex_volume.h"
#include "core/depth_span.h"
#include "core/integer_light.h"
#include "plan/capabilities.h"
#include "plan/light_sampling.h"
#include "plan/shading_settings.h"
#include "plan/shadow_mode.h"
#include "plan/skipped_effect.h"
#include "shadow/shadow_map.h"
#include "shadow/warp/warp.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::plan {

/// A point light, whose light decreases with the square of the distance.
struct PointLight {
    glm::dvec3 at{0}; // position in world space, on the model's grid
    double reach = 1; // distance at which it is as bright as the sun, in world units; above 0

    bool operator==(const PointLight&) const = default;
};

/// The camera, the image size, the light and the section planes of a frame.
struct View {
    Camera camera;
    int width = 800; // pixels, at least 1
    int height = 800;
    // direction in world space, of any length above 0; drawing uses light() instead
    glm::dvec3 towardsLight{0.4, 1, 0.3};
    glm::dvec3 up{0, 1, 0}; // towards the zenith, of any length above 0
    // if set, replaces towardsLight, which is then the approximate direction to the point light
    std::optional<PointLight> pointLight;
    double sunAngleRadians = 0;         // angle of the light's disc; 0: the light is a point
    std::optional<double> eyeMovedBack; // distance by which distantView moved the eye, in world units
    std::vector<Plane> sections;        // in world space; a point is visible only on the inner side of all planes
    bool cutsCasters = true;            // true: the part that the section planes remove casts no shadows

    /// Returns the light direction, rounded to integers. All drawing must use this direction, so that rounding occurs
    /// only here.
    IntegerLight light() const { return roundedLight(towardsLight); }

    double aspect() const { return static_cast<double>(width) / height; }

    double tanHalfY() const { return std::tan(camera.fovYRadians / 2); }

    double tanHalfX() const { return aspect() * tanHalfY(); }

    bool operator==(const View&) const = default;
};

/// The layout of the grids into which exact shadows sort the visible points: one grid or four slices, with or without a
/// perspective warp. The image is the same for all layouts.
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

/// The casters that a shadow map draws.
/// - Off: the whole model.
/// - On: the casters that can throw a shadow into the region that the map covers.
/// - Receivers: the casters of On that can change a pixel of the image.
/// - Auto: On or Receivers.
enum class CasterCulling : std::uint8_t { Auto, On, Off, Receivers };
inline constexpr std::array kCasterCullings = {
    Word<CasterCulling>{CasterCulling::Auto, "auto"},
    Word<CasterCulling>{CasterCulling::On, "on"},
    Word<CasterCulling>{CasterCulling::Off, "off"},
    Word<CasterCulling>{CasterCulling::Receivers, "receivers"},
};

/// Slices without a visible surface that faces the light: they have no map (Drop), or a map as in the paper (Keep).
enum class EmptySlices : std::uint8_t { Drop, Keep };
inline constexpr std::array kEmptySlices = {
    Word<EmptySlices>{EmptySlices::Drop, "drop"},
    Word<EmptySlices>{EmptySlices::Keep, "keep"},
};

/// The user's settings, with the names of the command line.
struct Quality {
    ShadowMode shadows = ShadowMode::Maps; // chooseShadows replaces ShadowMode::Auto by the chosen type
    // the reason why ShadowMode::Auto selects Maps; nullopt: the backend determines the type of shadows
    std::optional<ShadowReason> mapsBecause;
    shadow::Warp warp;
    std::optional<int> zPartitions = 4; // number of depth slices; nullopt: auto
    double splitLambda = 1;
    EmptySlices emptySlices = EmptySlices::Drop;
    Choice facePartitions = Choice::Off;
    int shadowTexelsWidth = 2048; // width times height is the total number of texels of all maps, borders included
    int shadowTexelsHeight = 2048;
    double maxAliasing = 4;
    int filter = 0; // width of the PCF kernel in texels; 0: one lookup without a filter
    CasterCulling cullCasters = CasterCulling::Auto;
    bool stabilize = false;
    CellScheme cellScheme = CellScheme::WarpedMap; // no command line option sets it; only a report compares the layouts
    std::optional<double> near;                    // nullopt: auto
    std::optional<double> far;
    std::optional<double> nearFloor; // nullopt: far / 10000
    double errorPixels = 1;
    std::optional<std::uint64_t> maxTriangles;
    Choice occlusion = Choice::Auto; // skips the hidden clusters of the image; Auto: only if this saves time
    ShadingSettings look;
    double lightError = 0.05; // max error of the visible fraction of the light's disc at a point
    SkyLight sky;

    bool operator==(const Quality&) const = default;
};

/// The properties of the visible scene that a plan needs. Some are known only after the traversal of the hierarchy.
struct SceneFacts {
    Box bounds; // bounds of the model and its ground, in world space

    /// The smallest and largest view depth of the surfaces drawn in the frustum.
    struct Visible {
        double nearest = 0;
        double farthest = 0;
        bool anything = false;
    };

    std::optional<Visible> visible;

    /// A set of clusters that can throw shadows into the view.
    struct CasterBlock {
        Box box; // world axes, relative to the eye
        std::uint64_t triangles = 0;
    };

    /// The receivers in the view, and the casters that can throw shadows onto them.
    struct Light {
        std::vector<DepthSpan> lit;       // depths of the visible surfaces that face the light: disjoint and sorted
        bool canBeShadowed = true;        // false: no caster can lie between the light and these surfaces
        std::vector<CasterBlock> casters; // all casters that can throw a shadow into the view
        std::vector<shadow::VisibleSlab> seen; // the visible parts of the scene, as slabs sorted by depth
    };

    std::optional<Light> light;
    bool isTurnedFromLight = false; // true: certainly no visible surface faces the light
    double layers = 0;              // mean number of clusters that overlap at a pixel, estimated from their boxes
};

/// A shadow map and how this frame draws it.
struct ShadowPass {
    shadow::ShadowMap map;
    // true: casters between the light and the depth range of the map are clamped to its near end
    bool clampsDepth = true;
    std::uint64_t estimatedTriangles = 0; // estimated number of caster triangles in this map
    // true: the texture already contains this map from the previous frame, so it is not drawn again
    bool isReused = false;
};

/// The plan of a frame: the view, the settings and the passes.
struct FramePlan {
    View view;
    Quality quality;      // `shadows` is the type that is drawn, never Auto
    Capabilities backend; // capabilities of the backend that draws the plan
    ShadowReason shadowReason = ShadowReason::Requested;
    CameraBasis basis;
    IntegerLight light;               // the light of the view
    glm::dvec3 towardsLight{0, 1, 0}; // the same direction as a unit vector in camera space
    double near = 0;                  // near end of the depth range in which shadow aliasing has an upper bound
    double far = 0;
    // [near, far], extended to all visible depths; shadows outside [near, far] have no aliasing bound
    DepthSpan shown;
    DepthSource nearFrom = DepthSource::Given;
    DepthSource farFrom = DepthSource::Given;
    double lightAngleRadians = 0;
    std::vector<double> splits; // depths that separate the slices, with both ends; empty without shadow maps
    bool hasFaces = false;
    shadow::PartitionSelector selector; // finds the partition (slice and face) of a point
    // Index in `passes` of the map of each partition, or -1 if the partition has no map. Partitions are numbered as by
    // `selector`, or as by shadow::cubeFaceOf for a point light.
    std::vector<int> passOfPartition;
    std::vector<ShadowPass> passes;
    std::vector<shadow::ShadowMap> sampleGridMaps; // maps whose projections define the grids of exact shadows
    shadow::Aliasing aliasingBound;                // max perspective aliasing in [near, far], over all passes, per axis
    double storageFactor = 0;
    CasterCulling casterCulling = CasterCulling::On; // never Auto
    // false: no permitted scheme keeps the aliasing below quality.maxAliasing
    bool isBoundKept = true;
    // Total number of shadow map texels with which the aliasing stays within quality.maxAliasing, or 0 if no number
    // suffices. If all permitted schemes need more texels than the budget, this is the smallest of their numbers.
    std::uint64_t requiredTexels = 0;
    // estimated drawing cost of the maps, in units of a caster triangle: caster triangles + texels / 16
    std::uint64_t cost = 0;
    Penumbra penumbra; // sampling of the sun's disc; only for images that are the mean of several frames
    SkyLight sky;      // sampling of the sky's light; only for images that are the mean of several frames
    std::vector<SkippedEffect> omitted;
    bool skipsHidden = false; // true: the image pass skips hidden clusters; the image is the same
    int textureWidth = 0;     // size of the depth texture in texels; 0 without maps
    int textureHeight = 0;
};

/// Converts the view depth `depth` from the eye of `plan` to the eye of the requested view. The two eyes differ only
/// for orthographic views.
inline double depthFromAskedEye(const FramePlan& plan, double depth) {
    return depth - plan.view.eyeMovedBack.value_or(0);
}

/// Returns the name of the plan's shadow scheme for the log: "off", "rays", "exact", "none", "map", "zp4" (four
/// slices), "fp" (face partitions) or "fp+zp4". The suffix "+w" marks warped maps and "+log" logarithmic maps. The
/// scheme of a point light is "cube".
std::string schemeName(const FramePlan& plan);

} // namespace gnomon::plan
