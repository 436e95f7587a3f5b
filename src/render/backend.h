// The interface of a backend, which draws a plan with OpenGL or with the software rasteriser.
#pragma once

#include "core/units.h"
#include "exact/exact_shadows.h"
#include "hierarchy/grid.h"
#include "hierarchy/page.h"
#include "lod/cut.h"
#include "plan/frame_plan.h"
#include "raster/raster.h"
#include "render/overlay/overlay.h"
#include "render/picture.h"
#include "shadow/image_tiles.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::raytrace {
class CutScene;
}

namespace gnomon::render {

/// Returns the decoded page with the id `page` from a draw list. The page stays valid until the frame is drawn.
using PageLookup = std::function<const hierarchy::Page&(std::uint32_t page)>;

/// Camera-relative space: it has the axes and units of the world, and its origin is the grid point of the model that is
/// nearest to the eye. Floats are therefore precise near the eye, even if the model is far from the world's origin or
/// the eye is far from the model.
struct CameraRelativeSpace {
    hierarchy::GridPoint originCell;
    double step = 1;
    glm::dvec3 eye{0};              // position of the eye in camera-relative space
    glm::dmat4 cameraFromDraw{1.0}; // from camera-relative space to left-handed camera space
};

/// Returns the camera-relative space of `view` for a model with the grid `grid`. `bounds` are the bounds of the model
/// in world space.
CameraRelativeSpace cameraRelativeSpace(const plan::View& view, const hierarchy::Grid& grid, const Box& bounds);

/// Returns the width of a pixel's beam at position `p` (camera-relative space) in world units: 2 tan(theta) (p.v) /
/// height.
double pixelWidth(const plan::FramePlan& plan, const CameraRelativeSpace& space, const glm::dvec3& p);

/// The reason why a cluster is drawn instead of its refinement.
enum class Residence : std::uint8_t {
    Final,   // the error of the cluster is small enough
    Pending, // the refinement is not in memory
    Damaged, // the refinement cannot be read
};

/// A drawn cluster that is coarser than the error limit requires.
struct LodSubstitute {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    Residence residence = Residence::Pending;
};

/// The part of the light that an image shows. An accumulated image can be the sum of images with different parts.
enum class LightPart : std::uint8_t {
    All,
    WithoutSky,   // light of the sun, the ground and the headlight
    SkyDirection, // only sky light from the direction of the plan's light
};

/// A range of rows of an image, counted from the bottom.
struct ImageRows {
    int first = 0;
    int count = 0;

    bool operator==(const ImageRows&) const = default;
};

/// The light that the surface of each pixel reflects towards the eye: linear RGB before tone mapping, with 1 as full
/// scale. A pixel without a surface has the value -1 + kGroundShade * s, where s is the fraction of the background's
/// light that a shadow on the ground removes.
using LightPicture = Raster<std::array<float, 3>>;

/// Scale of ground shadows in a LightPicture. With this scale, a pixel without a surface stays negative in the sum over
/// several light directions.
inline constexpr float kGroundShade = 1.0F / 16;

struct SectionMemory;

/// The complete input for drawing one frame.
struct DrawInputs {
    const plan::FramePlan* plan = nullptr;
    CameraRelativeSpace space;
    hierarchy::Grid grid;
    const lod::DrawList* image = nullptr;
    std::vector<const lod::DrawList*> casters; // one list per shadow pass
    PageLookup pages;
    double clipNear = 1e-3; // view depth of the near clip plane; no drawn geometry is nearer
    // View depth of the far clip plane of an orthographic image. Perspective images do not use it.
    double clipFar = 0;
    std::optional<Camera> observerCamera; // if set, the image is drawn from this camera instead of the plan's camera
    // Sample position relative to the centre of each pixel, in pixels to the right and up.
    glm::dvec2 subpixel{0};
    Overlay overlay = Overlay::None;
    plan::Shading shading = plan::Shading::Lit; // never Auto
    // The clusters in the image that are coarser than required, sorted by page and cluster. Only Overlay::Residency
    // needs them.
    std::vector<LodSubstitute> substitutes;
    bool wantsSurfaces = false; // stores the result of `surfaces`
    bool wantsLight = false;    // stores the result of `light`; excludes wantsSurfaces
    LightPart lightPart = LightPart::All;
    double skyWeight = 0;                       // weight of LightPart::SkyDirection, as in light_model.h
    std::vector<const lod::DrawList*> sections; // one list per section plane of the view: all clusters near the plane
    SectionMemory* sectionMemory = nullptr;     // cached sections of the model
    // the ground as a page with one cluster, which shows only shadows; null: no ground
    const hierarchy::Page* ground = nullptr;
    // Fraction of the background's light that a ground shadow removes, per channel. The default is the fraction of the
    // sun's light.
    std::optional<glm::vec3> groundShade;
    // 255 for lit pixels; if not null, it replaces lookups in shadow maps
    const Raster<std::uint8_t>* litMask = nullptr;
    // additional casters for drawExactly; the clusters of the image also cast shadows
    const lod::DrawList* exactCasters = nullptr;
    // If drawExactly finds fewer lit pixels than this number, it shades with the headlight.
    std::optional<std::uint64_t> minLitPixels;
    // A ray-tracing scene of the image and exactCasters. If not null, drawExactly traces rays instead of rasterising
    // casters.
    const raytrace::CutScene* rays = nullptr;
    std::optional<ImageRows> rows; // rows to draw, if the backend has the capability `bands`; nullopt: all rows
    // Tiles of the image to draw, if the backend supports this. Null means all tiles.
    const shadow::TileMask* tiles = nullptr;
    // true: skips parts of maps that no pixel looks up, and casters that cannot change a pixel; needs the capability
    // `imageFirst`
    bool cullsByReceivers = false;
};

/// Returns the rows of the image that `frame` draws.
inline ImageRows rowsOf(const DrawInputs& frame) {
    return frame.rows.value_or(ImageRows{0, frame.plan->view.height});
}

/// The cost of all shadow passes, or of the image pass.
struct PassStatistics {
    Milliseconds time; // wall-clock time, including the wait for the GPU
    std::uint64_t drawCalls = 0;
    std::optional<std::uint64_t> fragments;             // covered pixels, summed over triangles; nullopt if not counted
    std::optional<raster::OcclusionCounts> occlusion{}; // only for an image with occlusion culling
};

/// The numbers of casters that shadow maps drew, if receivers culled the casters.
struct CulledCasters {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;
    std::uint64_t triangles = 0; // drawn triangles
    std::uint64_t mapsDrawn = 0;
};

/// The cost of drawing a frame.
struct DrawStatistics {
    PassStatistics shadows;
    PassStatistics image;
    std::optional<CulledCasters> culled;         // only if receivers culled the casters
    std::optional<exact::ExactStatistics> exact; // only with exact shadows
    // true: shaded with the headlight, because fewer pixels than `minLitPixels` were lit
    bool isHeadlit = false;
    Bytes deviceMemory; // memory of geometry and textures
};

/// The visible surface of a pixel.
struct SurfaceSample {
    glm::vec3 normal{0};       // normal of the triangle, towards the viewer; camera-relative space
    float partitionAndLit = 0; // partition + 1 + lit fraction / 2; -1 if the surface faces away from the light
    glm::vec3 position{0};     // position of the shadow lookup; camera-relative space
    float isSurface = 0;       // 1 if the pixel shows a surface, otherwise 0

    bool isLitSide() const { return isSurface > 0 && partitionAndLit >= 0; }

    /// Returns the index of the pass whose map was looked up, or -1 without a lookup.
    int partition() const { return static_cast<int>(partitionAndLit) - 1; }

    /// Returns the lit fraction, from 0 to 1.
    float litFraction() const { return 2 * (partitionAndLit - std::floor(partitionAndLit)); }
};

/// The triangle of the model that a pixel shows.
struct SeenTriangle {
    // kNone if the pixel shows no triangle of the model, but the background, the ground or the cap of a section
    std::uint32_t page = hierarchy::kNone;
    std::uint32_t cluster = 0; // index in the page; `vertices` are also indices in the page
    std::array<std::uint32_t, 3> vertices{};
};

/// Draws frames: first the shadow maps of a frame, then its image. The functions that return results refer to the last
/// frame.
class Backend {
public:
    Backend() = default;
    virtual ~Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    Backend(Backend&&) = delete;
    Backend& operator=(Backend&&) = delete;

    /// Returns the name for the log column `backend`: "osmesa", "egl", ...
    virtual std::string name() const = 0;
    /// Draws the maps of all passes. Maps that the plan reuses stay unchanged. This function must be called first in
    /// each frame, even in a frame without maps.
    virtual PassStatistics drawShadowMaps(const DrawInputs& frame) = 0;
    /// Draws the image. The shadows come from the maps or from the frame's `litMask`.
    virtual PassStatistics drawImage(const DrawInputs& frame) = 0;

    /// Returns the optional effects that the backend can draw.
    virtual plan::Capabilities capabilities() const { return plan::kOpenGlCapabilities; }

    /// Returns the OpenGL name of the texture with the colours of the last frame, bottom row first. Returns 0 if the
    /// backend draws into no texture.
    virtual std::uint32_t texture() const { return 0; }

    /// Draws the image of a frame whose plan has exact shadows or rays. The function finds the visible points, computes
    /// their shadows, and shades each pixel once. Throws Error if the backend does not support exact shadows.
    virtual DrawStatistics drawExactly(const DrawInputs& frame);

    /// Returns the memory of geometry and textures since the last frame.
    virtual Bytes deviceMemory() const = 0;

    /// Draws the maps and the image of a frame. The picture is the same with and without culling by receivers.
    virtual DrawStatistics draw(const DrawInputs& frame);

    /// Returns the drawn rows of the image. The functions below also return these rows.
    virtual Picture picture() = 0;
    /// Returns the light of the image before tone mapping, from which `picture` is computed. Requires a frame with
    /// `wantsLight`.
    virtual LightPicture light() = 0;
    /// Returns the number of pixels that are at least partly lit. Returns nullopt if counting would delay later frames.
    /// With a GPU, a count is therefore available only for some frames.
    virtual std::optional<std::uint64_t> litPixels() = 0;
    /// Returns the view depth per pixel, measured from the requested eye. Pixels without a visible surface have
    /// infinite depth.
    virtual FloatPicture viewDepth() = 0;

    /// Returns the coverage of each pixel. If a transparent background has a ground, the coverage of a ground pixel is
    /// the darkness of its shadow.
    virtual Coverage coverage() { return coverageOf(viewDepth()); }

    /// Returns the whole depth texture of the shadow maps. Its rows are in memory order, row 0 first.
    virtual FloatPicture shadowDepth() = 0;
    /// Returns the surface of each pixel. Requires a frame with `wantsSurfaces`.
    virtual Raster<SurfaceSample> surfaces() = 0;

    /// Returns the triangle that each pixel shows. Returns an empty raster if the backend lacks the capability
    /// `seesTriangles`.
    virtual Raster<SeenTriangle> seenTriangles() const { return {}; }
};

} // namespace gnomon::render
