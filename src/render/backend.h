// The interface of the two backends (OpenGL and software), which draw the shadow maps and the image of a frame.
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

/// Returns the decoded page with the id `page`. The page stays valid until the frame is drawn.
using PageLookup = std::function<const hierarchy::Page&(std::uint32_t page)>;

/// Camera-relative space: the coordinate system with the axes and units of the world and the origin at the grid point
/// of the model nearest to the eye. Floats are therefore precise near the eye, even if the model is far from the
/// world's origin or the eye is far from the model.
struct CameraRelativeSpace {
    hierarchy::GridPoint originCell;
    double step = 1;
    glm::dvec3 eye{0};              // position of the eye in camera-relative space
    glm::dmat4 cameraFromDraw{1.0}; // from camera-relative space to left-handed camera space
};

/// Returns the camera-relative space for `view` and a model with the grid `grid`. `bounds` are the bounds of the model
/// in world space.
CameraRelativeSpace cameraRelativeSpace(const plan::View& view, const hierarchy::Grid& grid, const Box& bounds);

/// Returns the width of a pixel's beam at position `p`, in world units: 2 tan(theta) (p.v) / height. `p` is in
/// camera-relative space.
double pixelWidth(const plan::FramePlan& plan, const CameraRelativeSpace& space, const glm::dvec3& p);

/// The reason why a coarse cluster is drawn instead of the finer clusters that it replaces.
enum class Residence : std::uint8_t {
    Final,   // the error of the cluster is small enough
    Pending, // the refinement is not in memory
    Damaged, // the refinement cannot be read
};

/// A drawn cluster that is coarser than the error limit allows, because finer data is not available.
struct LodSubstitute {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    Residence residence = Residence::Pending;
};

/// The light sources that an image contains. An accumulated image can be the sum of images with different sources.
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

/// The light that each pixel reflects towards the eye: linear RGB before tone mapping, with 1 as full scale. A pixel
/// without a surface has the value -1 + kGroundShade * s, where s is the fraction of the background's light that a
/// shadow on the ground removes.
using LightPicture = Raster<std::array<float, 3>>;

/// Scale factor of ground shadows in a LightPicture. It is so small that a pixel without a surface stays negative in
/// the sum over several light directions.
inline constexpr float kGroundShade = 1.0F / 16;

struct SectionMemory;

/// The complete input of a backend for drawing one frame.
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
    // Sample position within each pixel, for antialiasing. The position is relative to the pixel's centre, in pixels
    // to the right and up.
    glm::dvec2 subpixel{0};
    Overlay overlay = Overlay::None;
    plan::Shading shading = plan::Shading::Lit; // never Auto
    // Clusters of the image that are coarser than the error limit allows, sorted by page and cluster. Only
    // Overlay::Residency needs this list.
    std::vector<LodSubstitute> substitutes;
    bool wantsSurfaces = false; // stores the result of `surfaces`
    bool wantsLight = false;    // stores the result of `light`; excludes wantsSurfaces
    LightPart lightPart = LightPart::All;
    double skyWeight = 0;                       // weight of LightPart::SkyDirection, as in light_model.h
    std::vector<const lod::DrawList*> sections; // one list per section plane of the view: all clusters near the plane
    SectionMemory* sectionMemory = nullptr;     // cached sections of the model
    // The ground plane as a page with one cluster, or null. The ground shows only shadows.
    const hierarchy::Page* ground = nullptr;
    // Fraction of the background's light that a shadow on the ground removes, per channel. The default is the sun's
    // fraction of the light.
    std::optional<glm::vec3> groundShade;
    // If not null: 255 for each lit pixel. The image then uses this mask instead of shadow maps.
    const Raster<std::uint8_t>* litMask = nullptr;
    // Additional casters for exact shadows. The clusters of the image also cast shadows.
    const lod::DrawList* exactCasters = nullptr;
    // Min number of lit pixels. If drawExactly finds fewer, it shades the image with the headlight.
    std::optional<std::uint64_t> minLitPixels;
    // A ray-tracing scene of all casters for exact shadows, or null. If not null, drawExactly traces rays instead of
    // testing each caster against the samples.
    const raytrace::CutScene* rays = nullptr;
    std::optional<ImageRows> rows; // rows to draw, if the backend has the capability `bands`; nullopt: all rows
    // The tiles of the image to draw, if the backend supports tiles. Null means all tiles.
    const shadow::TileMask* tiles = nullptr;
    // If true, the backend skips shadow map texels that no pixel reads, and casters that cannot change a pixel.
    // Requires the capability `imageFirst`.
    bool cullsByReceivers = false;
};

/// Returns the rows of the image that `frame` draws.
inline ImageRows rowsOf(const DrawInputs& frame) {
    return frame.rows.value_or(ImageRows{0, frame.plan->view.height});
}

/// The cost of drawing all shadow maps, or of drawing the image.
struct PassStatistics {
    Milliseconds time; // wall-clock time, including the wait for the GPU
    std::uint64_t drawCalls = 0;
    std::optional<std::uint64_t> fragments;             // covered pixels, summed over triangles; nullopt if not counted
    std::optional<raster::OcclusionCounts> occlusion{}; // only for an image with occlusion culling
};

/// The numbers of clusters that receiver culling tested and that the shadow maps then drew.
struct CulledCasters {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;
    std::uint64_t triangles = 0; // drawn triangles
    std::uint64_t mapsDrawn = 0;
};

/// The cost of drawing one frame.
struct DrawStatistics {
    PassStatistics shadows;
    PassStatistics image;
    std::optional<CulledCasters> culled;         // only if receivers culled the casters
    std::optional<exact::ExactStatistics> exact; // only with exact shadows
    // True if the image was shaded with the headlight, because fewer than `minLitPixels` pixels were lit.
    bool isHeadlit = false;
    Bytes deviceMemory; // memory of geometry and textures
};

/// The surface that is visible at a pixel, and its lit state.
struct SurfaceSample {
    glm::vec3 normal{0};       // normal of the triangle, towards the viewer; camera-relative space
    float partitionAndLit = 0; // partition + 1 + lit fraction / 2; -1 if the surface faces away from the light
    glm::vec3 position{0};     // position of the shadow lookup; camera-relative space
    float isSurface = 0;       // 1 if the pixel shows a surface, otherwise 0

    bool isLitSide() const { return isSurface > 0 && partitionAndLit >= 0; }

    /// Returns the index of the shadow map that the pixel used, or -1 if it used none.
    int partition() const { return static_cast<int>(partitionAndLit) - 1; }

    /// Returns the lit fraction of the pixel, from 0 to 1.
    float litFraction() const { return 2 * (partitionAndLit - std::floor(partitionAndLit)); }
};

/// The triangle of the model that is visible at a pixel.
struct SeenTriangle {
    // kNone if the pixel shows no triangle of the model, but the background, the ground or the cap of a section.
    std::uint32_t page = hierarchy::kNone;
    std::uint32_t cluster = 0; // index in the page; `vertices` are also indices in the page
    std::array<std::uint32_t, 3> vertices{};
};

/// Draws frames: first the shadow maps of a frame, then its image. All functions that return results refer to the last
/// frame.
class Backend {
public:
    Backend() = default;
    virtual ~Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    Backend(Backend&&) = delete;
    Backend& operator=(Backend&&) = delete;

    /// Returns the backend's name for the log, for example "osmesa" or "egl".
    virtual std::string name() const = 0;
    /// Draws all shadow maps of the frame, except maps that the plan reuses. This function must be called first in each
    /// frame, even in a frame without maps.
    virtual PassStatistics drawShadowMaps(const DrawInputs& frame) = 0;
    /// Draws the image of the frame. Shadows come from the shadow maps, or from `litMask` if it is not null.
    virtual PassStatistics drawImage(const DrawInputs& frame) = 0;

    /// Returns the optional effects that this backend supports.
    virtual plan::Capabilities capabilities() const { return plan::kOpenGlCapabilities; }

    /// Returns the OpenGL name of the texture with the colours of the last image, bottom row first. Returns 0 if the
    /// backend does not draw into a texture.
    virtual std::uint32_t texture() const { return 0; }

    /// Draws the image of a frame with exact or ray-traced shadows. The function finds the visible points, computes
    /// their shadows, and shades each pixel once. Throws Error if the backend does not support exact shadows.
    virtual DrawStatistics drawExactly(const DrawInputs& frame);

    /// Returns the memory of geometry and textures after the last frame.
    virtual Bytes deviceMemory() const = 0;

    /// Draws the shadow maps and the image of a frame. Receiver culling does not change the image.
    virtual DrawStatistics draw(const DrawInputs& frame);

    /// Returns the colours of the last image. This function and the functions below return only the drawn rows.
    virtual Picture picture() = 0;
    /// Returns the light of the last image before tone mapping. Requires a frame with `wantsLight`.
    virtual LightPicture light() = 0;
    /// Returns the number of pixels that are at least partly lit. Returns nullopt if counting would delay later frames,
    /// so a GPU returns a count only for some frames.
    virtual std::optional<std::uint64_t> litPixels() = 0;
    /// Returns the view depth of each pixel, measured from the requested eye. Pixels without a visible surface have
    /// infinite depth.
    virtual FloatPicture viewDepth() = 0;

    /// Returns the coverage (opacity) of each pixel. If the image has a transparent background and a ground, the
    /// coverage of a ground pixel is the darkness of its shadow.
    virtual Coverage coverage() { return coverageOf(viewDepth()); }

    /// Returns the depth texture that contains all shadow maps, with row 0 first.
    virtual FloatPicture shadowDepth() = 0;
    /// Returns the visible surface of each pixel. Requires a frame with `wantsSurfaces`.
    virtual Raster<SurfaceSample> surfaces() = 0;

    /// Returns the triangle that is visible at each pixel, or an empty raster if the backend lacks the capability
    /// `seesTriangles`.
    virtual Raster<SeenTriangle> seenTriangles() const { return {}; }
};

} // namespace gnomon::render
