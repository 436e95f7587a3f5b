// The interface of a backend, which draws a frame plan with OpenGL or the software rasteriser.
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

/// Returns the decoded page of an id in a draw list. The page stays valid until the frame is drawn.
using PageLookup = std::function<const hierarchy::Page&(std::uint32_t page)>;

/// Camera-relative space: world axes and units, with the origin at the grid point of the model that is nearest to the
/// eye. Floats are therefore precise near the eye, also if the model is far from the world's origin or the eye is far
/// from the model.
struct CameraRelativeSpace {
    hierarchy::GridPoint originCell;
    double step = 1;
    glm::dvec3 eye{0};              // in camera-relative space
    glm::dmat4 cameraFromDraw{1.0}; // to left-handed camera space
};

/// Returns the camera-relative space of `view` on `grid`. `bounds` are the bounds of the model in world space.
CameraRelativeSpace cameraRelativeSpace(const plan::View& view, const hierarchy::Grid& grid, const Box& bounds);

/// Returns the width of a pixel's beam at `p` (camera-relative space) in world units: 2 tan(theta) (p.v) / height.
double pixelWidth(const plan::FramePlan& plan, const CameraRelativeSpace& space, const glm::dvec3& p);

/// The reason why a cluster is drawn and not a finer one.
enum class Residence : std::uint8_t {
    Final,   // its error is small enough
    Pending, // its refinement is not in memory
    Damaged, // its refinement cannot be read
};

/// A drawn cluster that is coarser than the error limit requires.
struct LodSubstitute {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    Residence residence = Residence::Pending;
};

/// The part of the light that an image shows. Some pictures are the sum of several such images.
enum class LightPart : std::uint8_t {
    All,
    WithoutSky,   // light of the sun, the ground and the headlight
    SkyDirection, // only the light from the direction of the plan's light, as a part of the sky
};

/// A range of rows of an image, counted from the bottom.
struct ImageRows {
    int first = 0;
    int count = 0;

    bool operator==(const ImageRows&) const = default;
};

/// The light that a pixel's surface reflects towards the eye: linear RGB before tone mapping, with 1 as full scale. A
/// pixel without a surface has the value -1 + kGroundShade * s. s is the share of the background's light that a shadow
/// on the ground removes.
using LightPicture = Raster<std::array<float, 3>>;

/// Scale of a ground shadow in a LightPicture. With this scale, the sum over several directions of light stays
/// negative.
inline constexpr float kGroundShade = 1.0F / 16;

struct SectionMemory;

/// One frame, ready to be drawn.
struct DrawInputs {
    const plan::FramePlan* plan = nullptr;
    CameraRelativeSpace space;
    hierarchy::Grid grid;
    const lod::DrawList* image = nullptr;
    std::vector<const lod::DrawList*> casters; // one list per pass
    PageLookup pages;
    double clipNear = 1e-3; // view depth of the near clip plane; nothing drawn is nearer
    // View depth of the far clip plane of an orthographic image. Perspective images do not use it.
    double clipFar = 0;
    std::optional<Camera> observerCamera; // draws the image from outside instead of the plan's camera
    // Sample position relative to the centre of each pixel, in pixels to the right and up.
    glm::dvec2 subpixel{0};
    Overlay overlay = Overlay::None;
    plan::Shading shading = plan::Shading::Lit; // never Auto
    // The substitutes in the image, sorted by page and cluster. Only Overlay::Residency needs them.
    std::vector<LodSubstitute> substitutes;
    bool wantsSurfaces = false; // stores the result of `surfaces`
    bool wantsLight = false;    // stores the result of `light`; excludes wantsSurfaces
    LightPart lightPart = LightPart::All;
    double skyWeight = 0;                       // weight of SkyDirection, as in light_model.h
    std::vector<const lod::DrawList*> sections; // per section plane of the view: all clusters near the plane
    SectionMemory* sectionMemory = nullptr;     // cached sections of the model
    const hierarchy::Page* ground = nullptr;    // a page with one cluster, which shows only shadows
    // Share of the background's light that a ground shadow removes. The default is the share of the sun.
    std::optional<glm::vec3> groundShade;
    const Raster<std::uint8_t>* litMask = nullptr; // 255 where a pixel is lit; used instead of maps
    const lod::DrawList* exactCasters = nullptr;   // casters of drawExactly besides the image's own clusters
    // Min number of lit pixels. If drawExactly finds fewer, it shades with the headlight.
    std::optional<std::uint64_t> minLitPixels;
    // A scene of the image and exactCasters. If it is given, drawExactly traces rays instead of rasterising casters.
    const raytrace::CutScene* rays = nullptr;
    std::optional<ImageRows> rows; // the only rows to draw, if the backend has the capability `bands`; default: all
    // The only tiles of the image to draw, if the backend supports this. Null means all tiles.
    const shadow::TileMask* tiles = nullptr;
    bool cullsByReceivers = false; // skips parts of maps that no pixel looks up; needs the capability `imageFirst`
};

/// Returns the rows that `frame` draws.
inline ImageRows rowsOf(const DrawInputs& frame) {
    return frame.rows.value_or(ImageRows{0, frame.plan->view.height});
}

/// The cost of the passes of one kind.
struct PassStatistics {
    Milliseconds time; // wall-clock time, including the wait for the GPU
    std::uint64_t drawCalls = 0;
    std::optional<std::uint64_t> fragments;             // covered pixels, with overdraw; empty if not counted
    std::optional<raster::OcclusionCounts> occlusion{}; // of an image with occlusion culling
};

/// Counts of the casters that shadow maps drew, if receivers culled them.
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
    std::optional<CulledCasters> culled;         // with culling by receivers
    std::optional<exact::ExactStatistics> exact; // of exact shadows
    bool isHeadlit = false;                      // true: fewer pixels than `minLitPixels` were lit
    Bytes deviceMemory;                          // geometry and textures
};

/// The visible surface of a pixel.
struct SurfaceSample {
    glm::vec3 normal{0};       // normal of the triangle, towards the viewer; camera-relative space
    float partitionAndLit = 0; // partition + 1 + lit fraction / 2; -1 if the surface faces away from the light
    glm::vec3 position{0};     // the point of the shadow lookup; camera-relative space
    float isSurface = 0;       // 1 if the pixel shows a surface, otherwise 0

    bool isLitSide() const { return isSurface > 0 && partitionAndLit >= 0; }

    /// Returns the index of the pass whose map was looked up, or -1 without a lookup.
    int partition() const { return static_cast<int>(partitionAndLit) - 1; }

    /// Returns the lit fraction, from 0 to 1.
    float litFraction() const { return 2 * (partitionAndLit - std::floor(partitionAndLit)); }
};

/// The triangle of the model that a pixel shows.
struct SeenTriangle {
    std::uint32_t page = hierarchy::kNone; // kNone where none is seen: the background, the ground, a section's cap
    std::uint32_t cluster = 0;             // in the page, as are:
    std::array<std::uint32_t, 3> vertices{};
};

/// Draws frames: a frame's shadow maps, then its image. The results are those of the last frame.
class Backend {
public:
    Backend() = default;
    virtual ~Backend() = default;
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;
    Backend(Backend&&) = delete;
    Backend& operator=(Backend&&) = delete;

    /// Returns the name for the column `backend`: "osmesa", "egl", ...
    virtual std::string name() const = 0;
    /// Draws the maps of all passes. Maps that the plan reuses stay unchanged. Call this first in each frame, also in a
    /// frame without maps.
    virtual PassStatistics drawShadowMaps(const DrawInputs& frame) = 0;
    /// Draws the image, lit by the maps or by the frame's `litMask`.
    virtual PassStatistics drawImage(const DrawInputs& frame) = 0;

    /// Returns what the backend can draw.
    virtual plan::Capabilities capabilities() const { return plan::kOpenGlCapabilities; }

    /// Returns the OpenGL name of the texture that holds the colours of the last frame, bottom row first. Returns 0 if
    /// the picture is not in a texture.
    virtual std::uint32_t texture() const { return 0; }

    /// Draws the image of a frame whose plan has exact shadows or rays: finds the visible points, computes their
    /// shadows, and shades each pixel once. Throws Error if the backend cannot.
    virtual DrawStatistics drawExactly(const DrawInputs& frame);

    /// Returns the memory of geometry and textures since the last frame.
    virtual Bytes deviceMemory() const = 0;

    /// Draws both passes of a frame. The picture is the same with and without culling by receivers.
    virtual DrawStatistics draw(const DrawInputs& frame);

    /// Returns the image of the drawn rows. The following functions return these rows too.
    virtual Picture picture() = 0;
    /// Returns the light of the image, from which `picture` is made. Requires a frame with `wantsLight`.
    virtual LightPicture light() = 0;
    /// Returns the number of pixels that are at least partly lit. Returns nullopt if counting would delay later frames.
    /// A GPU therefore returns a count only from time to time.
    virtual std::optional<std::uint64_t> litPixels() = 0;
    /// Returns the view depth per pixel, measured from the requested eye. The depth is infinite if no surface is
    /// visible.
    virtual FloatPicture viewDepth() = 0;

    /// Returns the coverage of each pixel. A transparent background with a ground has the darkness of its shadow as
    /// coverage.
    virtual Coverage coverage() { return coverageOf(viewDepth()); }

    /// Returns the whole depth texture of the shadow maps. Its rows are in memory order, row 0 first.
    virtual FloatPicture shadowDepth() = 0;
    /// Returns the surface of each pixel. Requires a frame with `wantsSurfaces`.
    virtual Raster<SurfaceSample> surfaces() = 0;

    /// Returns the triangle that each pixel shows. Empty without the capability `seesTriangles`.
    virtual Raster<SeenTriangle> seenTriangles() const { return {}; }
};

} // namespace gnomon::render
