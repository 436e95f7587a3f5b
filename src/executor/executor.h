// Executes a frame plan: one interface for OpenGL and the software rasteriser.
#pragma once

#include "core/units.h"
#include "exact/exact_shadows.h"
#include "executor/picture.h"
#include "hierarchy/grid.h"
#include "hierarchy/page.h"
#include "plan/frame_plan.h"
#include "raster/raster.h"
#include "selection/cut.h"
#include "shadow/image_tiles.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::raycast {
class CutScene;
}

namespace gnomon::executor {

/// The decoded page of an id that a draw list names; valid until the frame is drawn.
using PageLookup = std::function<const hierarchy::Page&(std::uint32_t page)>;

/// What is painted over the image.
/// Aliasing is its perspective part, which a plan promises; Projection the other factor, which depends on how the
/// surface lies to light and eye, and which nobody can promise.
/// Residency is what is drawn coarser than called for, since finer pages are not in memory.
enum class Overlay : std::uint8_t { None, Partitions, Texels, Aliasing, Lod, Clusters, Projection, Residency };

/// An overlay with its word, and what it is called where there is room.
struct NamedOverlay {
    Overlay value;
    const char* word;
    const char* title;
};

/// All of them, in the order in which a window offers them.
inline constexpr std::array kOverlays = {
    NamedOverlay{Overlay::None, "none", "none"},
    NamedOverlay{Overlay::Partitions, "partitions", "partitions"},
    NamedOverlay{Overlay::Texels, "texels", "shadow texels"},
    NamedOverlay{Overlay::Aliasing, "aliasing", "aliasing"},
    NamedOverlay{Overlay::Lod, "lod", "level of detail"},
    NamedOverlay{Overlay::Clusters, "clusters", "clusters"},
    NamedOverlay{Overlay::Residency, "residency", "what waits for pages"},
    NamedOverlay{Overlay::Projection, "projection", "projection"},
};

/// Whether `overlay` shows something of shadow maps.
constexpr bool isOfMaps(Overlay overlay) {
    return overlay == Overlay::Partitions || overlay == Overlay::Texels || overlay == Overlay::Aliasing ||
           overlay == Overlay::Projection;
}

/// What `overlay` is called where there is room.
constexpr const char* title(Overlay overlay) {
    for (const NamedOverlay& each : kOverlays)
        if (each.value == overlay) return each.title;
    return "";
}

/// World axes and units, origin at the grid point of the model that is nearest to the eye: there floats are precise
/// where the picture needs it, however far from the world's origin or how far away the eye is.
struct DrawSpace {
    hierarchy::GridPoint originCell;
    double step = 1;
    glm::dvec3 eye{0};              // in draw space
    glm::dmat4 cameraFromDraw{1.0}; // left-handed camera space
};

/// The draw space of `view` on `grid`; `bounds` are those of the model, world space.
DrawSpace drawSpace(const plan::View& view, const hierarchy::Grid& grid, const Box& bounds);

/// The width of a pixel's image beam at `p` (draw space), world units: 2 tan(theta) (p.v) / height.
double pixelWidth(const plan::FramePlan& plan, const DrawSpace& space, const glm::dvec3& p);

/// Why a cluster is drawn.
enum class Residence : std::uint8_t {
    Final,   // the error calls for nothing finer
    Pending, // what refines it is not in memory
    Damaged, // what refines it cannot be read
};

/// A drawn cluster that is coarser than the error calls for.
struct LodSubstitute {
    std::uint32_t page = 0;
    std::uint32_t cluster = 0;
    Residence residence = Residence::Pending;
};

/// What of a surface's light an image shows, where a picture is the sum of several.
enum class LightPart : std::uint8_t {
    All,
    WithoutSky,   // sun, ground and what comes from the eye
    SkyDirection, // what comes from the direction of the plan's light alone, as part of the sky
};

/// Some rows of an image, counted from the bottom.
struct ImageRows {
    int first = 0;
    int count = 0;

    bool operator==(const ImageRows&) const = default;
};

/// The light that a pixel's surface reflects towards the eye, linear RGB before the shoulder, 1 being full scale. Below
/// 0 where no surface is: -1, and more by kGroundShade of what a shadow on the ground takes of the background's light.
using LightPicture = Raster<std::array<float, 3>>;

/// What a shadow on the ground takes may count several times where it is one direction of many.
inline constexpr float kGroundShade = 1.0F / 16;

struct SectionMemory;

/// One frame, ready to be drawn.
struct FrameDrawing {
    const plan::FramePlan* plan = nullptr;
    DrawSpace space;
    hierarchy::Grid grid;
    const selection::DrawList* image = nullptr;
    std::vector<const selection::DrawList*> casters; // one a pass
    PageLookup pages;
    double clipNear = 1e-3;               // view depth of the near clip plane: nothing that is drawn lies before it
    double clipFar = 0;                   // nor behind this; of an orthographic image, and anything of others
    std::optional<Camera> observerCamera; // sees the image in place of the plan's camera: from outside its frustum
    glm::dvec2 subpixel{0};               // where the image samples its pixels: from their middles, right and up
    Overlay overlay = Overlay::None;
    plan::Shading shading = plan::Shading::Lit; // never Auto
    std::vector<LodSubstitute> substitutes;     // of the image, by page and cluster; for Overlay::Residency alone
    bool wantsSurfaces = false;                 // keep what `surfaces` returns
    bool wantsLight = false;                    // keep what `light` returns; not both
    LightPart lightPart = LightPart::All;
    double skyWeight = 0;                             // of SkyDirection: what it counts for, as light_model.h has it
    std::vector<const selection::DrawList*> sections; // by plane of the view's: all clusters that lie near it
    SectionMemory* sectionMemory = nullptr;           // of these and of the model
    const hierarchy::Page* ground = nullptr;          // one cluster, on which nothing but shadows is seen
    std::optional<glm::vec3> groundShade; // what a shadow takes of its background's light; else as much as the sun's
    const Raster<std::uint8_t>* litMask = nullptr;     // 255 where the light reaches, instead of maps
    const selection::DrawList* exactCasters = nullptr; // of drawExactly, besides the image's own clusters
    const raycast::CutScene* rays = nullptr;           // of both: decide what drawExactly else does by casting
    std::optional<ImageRows> rows; // the only rows that are drawn and held, with the capability `bands`; nothing: all
    const shadow::TileMask* tiles = nullptr; // of the image, where alone it is drawn, if the executor can; null: all
    bool cullsByReceivers =
        false; // maps need not hold what no pixel of the image asks for; with the capability `imageFirst`
};

/// The rows that `frame` draws.
inline ImageRows rowsOf(const FrameDrawing& frame) {
    return frame.rows.value_or(ImageRows{0, frame.plan->view.height});
}

/// What one kind of passes took.
struct PassStatistics {
    Milliseconds time; // wall-clock around finished work
    std::uint64_t drawCalls = 0;
    std::optional<std::uint64_t> fragments;             // pixels that the triangles cover, summed; if counted
    std::optional<raster::OcclusionCounts> occlusion{}; // of an image without what is hidden
};

/// What shadow maps drew of their casters, where receivers culled them.
struct CulledCasters {
    std::uint64_t clustersTested = 0;
    std::uint64_t clustersKept = 0;
    std::uint64_t triangles = 0; // drawn
    std::uint64_t mapsDrawn = 0;
};

/// What drawing a frame took.
struct DrawStatistics {
    PassStatistics shadows;
    PassStatistics image;
    std::optional<CulledCasters> culled;         // by receivers
    std::optional<exact::ExactStatistics> exact; // of exact shadows
    Bytes deviceMemory;                          // geometry and textures held
};

/// What is known of a pixel's surface.
struct SurfaceSample {
    glm::vec3 normal{0};       // flat, towards the viewer; draw space
    float partitionAndLit = 0; // partition + 1 + lit fraction / 2; -1 where the surface is turned from the light
    glm::vec3 position{0};     // the very point whose shadow was looked up; draw space
    float isSurface = 0;       // 1 where anything is, else 0

    bool isLitSide() const { return isSurface > 0 && partitionAndLit >= 0; }

    /// The map that was looked up, by the plan's passes; -1 if none was.
    int partition() const { return static_cast<int>(partitionAndLit) - 1; }

    /// From 0 to 1.
    float litFraction() const { return 2 * (partitionAndLit - std::floor(partitionAndLit)); }
};

/// The triangle of the model that a pixel shows.
struct SeenTriangle {
    std::uint32_t page = hierarchy::kNone; // kNone where none is seen: the background, the ground, a section's cap
    std::uint32_t cluster = 0;             // in the page, as are:
    std::array<std::uint32_t, 3> vertices{};
};

/// Draws frames: a frame's shadow maps, then its image. The results are those of the last frame.
class Executor {
public:
    Executor() = default;
    virtual ~Executor() = default;
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;
    Executor(Executor&&) = delete;
    Executor& operator=(Executor&&) = delete;

    /// "osmesa", "egl", ...: the column `backend`.
    virtual std::string name() const = 0;
    /// Draws the maps of all passes; those that the plan reuses stay as the last frame left them. Comes first in every
    /// frame, one without maps too.
    virtual PassStatistics drawShadowMaps(const FrameDrawing& frame) = 0;
    /// Draws the image, lit through the maps or by the frame's `litMask`.
    virtual PassStatistics drawImage(const FrameDrawing& frame) = 0;

    /// Returns what the backend can draw.
    virtual plan::Capabilities capabilities() const { return plan::kOpenGlCapabilities; }

    /// Returns the OpenGL name of the texture that holds the colours of the last frame, bottom row first. Returns 0 if
    /// the picture is not in a texture.
    virtual std::uint32_t texture() const { return 0; }

    /// Draws the image of a frame whose plan asks for exact shadows or for rays: what is visible first, then who stands
    /// in its light. Throws Error where the executor cannot.
    virtual DrawStatistics drawExactly(const FrameDrawing& frame);

    /// What geometry and textures hold since the last frame.
    virtual Bytes deviceMemory() const = 0;

    /// Both passes of a frame; the same picture whether receivers cull casters or not.
    virtual DrawStatistics draw(const FrameDrawing& frame);

    /// Of the rows that were drawn, as is all that follows.
    virtual Picture picture() = 0;
    /// Only after a frame with `wantsLight`; what `picture` shows is made of it.
    virtual LightPicture light() = 0;
    /// The pixels of the image that the light reaches, at least in part; nothing where finding out would hold up the
    /// frames to come, as it would a GPU's: those say so now and then.
    virtual std::optional<std::uint64_t> litPixels() = 0;
    /// View depth per pixel, from the eye that was asked for; infinity where nothing is.
    virtual FloatPicture viewDepth() = 0;

    /// How much of each pixel what was drawn covers; of a transparent background with a ground, how dark that is.
    virtual Coverage coverage() { return coverageOf(viewDepth()); }

    /// The whole depth texture of the shadow maps, rows from top to bottom as they lie in memory (row 0 first).
    virtual FloatPicture shadowDepth() = 0;
    /// Only after a frame with `wantsSurfaces`.
    virtual Raster<SurfaceSample> surfaces() = 0;

    /// Returns the triangle that each pixel shows. Empty without the capability `seesTriangles`.
    virtual Raster<SeenTriangle> seenTriangles() const { return {}; }
};

} // namespace gnomon::executor
