#include "render/exact_pass.h"

#include "exact/plain_shadows.h"
#include "render/frame_block.h"
#include "render/view/section_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace gnomon::render {

namespace {

/// The drawn clusters of the image, as a set that can be searched by page and cluster.
class ClusterSet {
public:
    ClusterSet(std::span<const DrawnCluster> clusters, bool withPieces) {
        for (const DrawnCluster& drawn : clusters) {
            if (drawn.isPiece && !withPieces) continue;
            std::vector<bool>& page = pages_[drawn.pageId];
            if (page.empty()) page.resize(drawn.page->clusters.size());
            page[drawn.cluster] = true;
        }
    }

    bool contains(std::uint32_t page, std::uint32_t cluster) const {
        const auto found = pages_.find(page);
        return found != pages_.end() && found->second[cluster];
    }

private:
    std::unordered_map<std::uint32_t, std::vector<bool>> pages_;
};

exact::Caster casterOf(const DrawInputs& frame, const hierarchy::Page& page, std::uint32_t index, std::size_t place) {
    const hierarchy::Cluster& cluster = page.clusters[index];
    const hierarchy::GridPoint origin = frame.space.originCell;
    // Subtraction modulo 2^32 gives correct differences even for positions outside the grid.
    const auto fromOrigin = [&](const hierarchy::GridPoint& p) {
        return glm::i64vec3(glm::ivec3(glm::uvec3(p.x, p.y, p.z) - glm::uvec3(origin.x, origin.y, origin.z)));
    };
    exact::Caster caster;
    caster.geometry = {
        &page.vertices[cluster.firstVertex].position.x,
        sizeof(hierarchy::Vertex),
        cluster.vertexCount,
        {page.triangles.data() + cluster.firstTriangle, cluster.triangleCount},
        static_cast<std::uint32_t>(place) << kTriangleBits};
    caster.min = fromOrigin(cluster.box.min);
    caster.max = fromOrigin(cluster.box.max);
    return caster;
}

/// Converts a cut piece of a cluster to a caster, with the piece's own corners.
exact::Caster casterOfPiece(const DrawInputs& frame, const raster::Cluster& piece) {
    const hierarchy::GridPoint origin = frame.space.originCell;
    exact::Caster caster;
    caster.geometry = piece;
    caster.min = glm::i64vec3(std::numeric_limits<std::int64_t>::max());
    caster.max = glm::i64vec3(std::numeric_limits<std::int64_t>::min());
    const std::size_t stride = piece.positionStride / sizeof(std::uint32_t);
    for (std::size_t v = 0; v < piece.vertexCount; ++v) {
        const std::uint32_t* p = piece.positions + v * stride;
        const glm::i64vec3 cell = glm::i64vec3(p[0], p[1], p[2]) - glm::i64vec3(origin.x, origin.y, origin.z);
        caster.min = glm::min(caster.min, cell);
        caster.max = glm::max(caster.max, cell);
    }
    return caster;
}

/// Returns the position of the eye in grid cells. A distant orthographic eye can exceed the range of fixed-point
/// coordinates with a precision of 2^-24. The eye is then moved along the view direction, which does not change the
/// parallel rays.
glm::dvec3 eyeCell(const DrawInputs& frame) {
    constexpr double kFarthest = 0x1p36;
    const glm::dvec3 eye = frame.space.eye / frame.space.step;
    const double excess = glm::length(eye) - kFarthest;
    return frame.plan->view.camera.isParallel() && excess > 0 ? eye + frame.plan->basis.view * excess : eye;
}

} // namespace

exact::SampleSpace sampleSpace(const DrawInputs& frame) {
    if (const auto& light = frame.plan->view.pointLight) {
        const glm::dvec3 cell = (light->at - frame.grid.origin) / frame.space.step;
        const hierarchy::GridPoint origin = frame.space.originCell;
        const glm::i64vec3 whole(std::llround(cell.x), std::llround(cell.y), std::llround(cell.z));
        return exact::pointSpace(whole - glm::i64vec3(origin.x, origin.y, origin.z), eyeCell(frame));
    }
    exact::SampleSpace space;
    space.light = frame.plan->light;
    space.shear = exact::shearAlong(space.light);
    space.eye = eyeCell(frame);
    // The plan has no maps if this function is called for the ground truth of shadow maps.
    space.maps = std::max(static_cast<int>(frame.plan->sampleGridMaps.size()), 1);
    return space;
}

std::uint32_t tolerance(const IntegerLight& light) {
    return exact::twoSteps(light);
}

std::optional<raster::OcclusionCounts> collectSamples(
    const DrawInputs& frame, const ImageBuffers& buffers, exact::SampleList& samples, UnresolvedPixels& unresolved) {
    const auto occlusion = drawVisible(frame, buffers);
    const exact::SampleSpace space = sampleSpace(frame);
    samples.reset(space, buffers.picture->pixels.size());
    unresolved.samples = &samples;
    unresolved.tolerance = tolerance(space.light);
    unresolved.sliceEnds.clear();
    for (const shadow::ShadowMap& map : frame.plan->sampleGridMaps)
        unresolved.sliceEnds.push_back(static_cast<float>(map.region.frustum.far));
    const glm::dmat4 clipFromDraw = imageClipFromDraw(frame);
    const FloatPicture noMaps;
    const Shading shading(frame, clipFromDraw, noMaps, buffers.pass->drawn(), Verdict::Unresolved);
    ShadingTarget target;
    target.picture = buffers.picture;
    target.unresolved = &unresolved;
    target.tiles = frame.tiles;
    shadeVisible(shading, *buffers.words, target);
    return occlusion;
}

void drawPoints(const DrawInputs& frame, const ImageBuffers& buffers, exact::VisiblePoints& points) {
    drawVisible(frame, buffers);
    points.reset(buffers.picture->pixels.size());
    UnresolvedPixels unresolved;
    unresolved.points = &points;
    const FloatPicture noMaps;
    const glm::dmat4 clipFromDraw = imageClipFromDraw(frame);
    const Shading collecting(frame, clipFromDraw, noMaps, buffers.pass->drawn(), Verdict::Unresolved);
    shadeVisible(collecting, *buffers.words, {buffers.picture, nullptr, &unresolved});
    const Raster<std::uint8_t> nothingLit(buffers.picture->width, buffers.picture->height);
    DrawInputs shadowed = frame;
    shadowed.litMask = &nothingLit;
    const Shading shading(shadowed, clipFromDraw, noMaps, buffers.pass->drawn());
    shadeVisible(shading, *buffers.words, {buffers.picture});
}

namespace {

/// Adds the drawn clusters of the image to `casters`, at the same indices. The ground and the pieces of cut clusters
/// are added without vertices. They throw no shadow, but samples can still refer to their triangles.
void addDrawnCasters(const DrawInputs& frame, const SoftwarePass& image, std::vector<exact::Caster>& casters) {
    for (std::size_t place = 0; place < image.drawn().size(); ++place) {
        const DrawnCluster& cluster = image.drawn()[place];
        casters.push_back(casterOf(frame, *cluster.page, cluster.cluster, place));
        if (!cluster.isGround && !cluster.isPiece) continue;
        raster::Cluster& geometry = casters.back().geometry;
        geometry.vertexCount = 0;
        geometry.triangles = {cluster.triangles, image.clusters()[place].triangles.size()};
    }
}

/// Adds the cut pieces of clusters to `casters`, from index `first` of the pass on. The id of a piece is the id of the
/// triangle from which it was cut.
void addPieceCasters(
    const DrawInputs& frame, const SoftwarePass& image, std::size_t first, std::vector<exact::Caster>& casters) {
    for (std::size_t place = first; place < image.drawn().size(); ++place)
        if (image.drawn()[place].isPiece) casters.push_back(casterOfPiece(frame, image.clusters()[place]));
}

/// Adds the parts of a cluster that the section planes do not remove to the casters.
void addCutCaster(
    const DrawInputs& frame,
    SoftwarePass& image,
    std::uint32_t page,
    std::uint32_t cluster,
    std::vector<exact::Caster>& casters) {
    const std::size_t first = image.drawn().size();
    image.addCut(frame, {page, cluster, 1});
    const bool isWhole = image.drawn().size() == first + 1 && !image.drawn().back().isPiece;
    if (isWhole)
        casters.push_back(casterOf(frame, frame.pages(page), cluster, casters.size()));
    else
        addPieceCasters(frame, image, first, casters);
}

} // namespace

void gatherExactCasters(const DrawInputs& frame, SoftwarePass& image, std::vector<exact::Caster>& casters) {
    casters.clear();
    const bool isCut = frame.plan->view.cutsCasters && !frame.plan->view.sections.empty();
    if (isCut) frame.sectionMemory->cut.cut(frame, frame.exactCasters->ranges);
    const ClusterSet drawn(image.drawn(), isCut);
    addDrawnCasters(frame, image, casters);
    if (isCut) addPieceCasters(frame, image, 0, casters);
    for (const lod::ClusterRange& range : frame.exactCasters->ranges) {
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            if (drawn.contains(range.page, c)) continue;
            if (isCut)
                addCutCaster(frame, image, range.page, c, casters);
            else
                casters.push_back(casterOf(frame, page, c, casters.size()));
        }
    }
}

std::vector<glm::dmat3> cellPlanes(const DrawInputs& frame, const exact::LightShear& shear) {
    std::vector<glm::dmat3> planes;
    if (frame.plan->view.pointLight) return planes; // a point light has one map per face of a cube around it
    for (const shadow::ShadowMap& map : frame.plan->sampleGridMaps) {
        const glm::dmat4 clip = map.lightClipFromCamera() * frame.space.cameraFromDraw;
        const auto column = [&](const glm::dvec4& p) {
            const glm::dvec4 c = clip * p;
            return glm::dvec3(c.x, c.y, c.w);
        };
        glm::dvec4 u(0);
        glm::dvec4 v(0);
        u[shear.first] = frame.space.step;
        v[shear.second] = frame.space.step;
        planes.emplace_back(column(u), column(v), column({0, 0, 0, 1}));
    }
    return planes;
}

Raster<std::uint8_t> statusesByIntegers(const DrawInputs& frame) {
    const plan::View& view = frame.plan->view;
    raster::Rasterizer rasterizer;
    SoftwarePass pass;
    Picture picture(view.width, view.height);
    std::vector<std::uint64_t> words(picture.pixels.size());
    exact::SampleList samples;
    UnresolvedPixels unresolved;
    plan::FramePlan whole = *frame.plan;
    whole.skipsHidden = false; // the ground truth does not rely on occlusion culling
    DrawInputs drawing = frame;
    drawing.plan = &whole;
    drawing.wantsLight = false;
    drawing.ground = nullptr; // the ground is not part of the model
    collectSamples(drawing, {&rasterizer, &pass, &words, &picture}, samples, unresolved);
    const hierarchy::GridPoint origin = frame.space.originCell;
    std::vector<exact::Caster> casters;
    gatherExactCasters(frame, pass, casters);
    const std::vector<std::uint8_t> statuses = exact::plainStatuses(samples, casters, {origin.x, origin.y, origin.z});
    Raster<std::uint8_t> result(view.width, view.height, kNoSample);
    for (std::size_t i = 0; i < samples.size(); ++i)
        result.pixels[samples.pixel[i]] = statuses[i];
    return result;
}

Raster<std::uint8_t> litByIntegers(const DrawInputs& frame) {
    Raster<std::uint8_t> lit = statusesByIntegers(frame);
    for (std::uint8_t& pixel : lit.pixels)
        pixel = pixel == kNoSample || exact::isDark(pixel) ? 0 : 255;
    return lit;
}

} // namespace gnomon::render
