#include "render/ray_shadows.h"

#include "core/stopwatch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace gnomon::render {

std::vector<lod::ClusterRange> distinctClusters(std::span<const lod::DrawList* const> lists) {
    // Each range contains one cluster, so that a cluster in several lists can be found and removed.
    std::vector<lod::ClusterRange> clusters;
    for (const lod::DrawList* list : lists)
        for (const lod::ClusterRange& range : list->ranges)
            for (std::uint32_t c = 0; c < range.clusterCount; ++c)
                clusters.push_back({range.page, range.firstCluster + c, 1});
    std::sort(clusters.begin(), clusters.end());
    clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
    return clusters;
}

raytrace::Scene rayScene(const DrawInputs& frame, std::span<const lod::DrawList* const> lists) {
    const std::vector<lod::ClusterRange> clusters = distinctClusters(lists);
    std::vector<raytrace::ClusterSpan> spans;
    spans.reserve(clusters.size());
    for (const lod::ClusterRange& cluster : clusters)
        spans.push_back({&frame.pages(cluster.page), cluster.firstCluster, 1});
    raytrace::Scene scene(spans, frame.grid, frame.grid.local(frame.space.originCell));
    const plan::View& view = frame.plan->view;
    if (view.sections.empty()) return scene;
    std::vector<Plane> planes;
    for (const Plane& plane : view.sections)
        planes.push_back({plane.normal, plane.signedDistance(frame.grid.world(frame.space.originCell))});
    scene.cutBy(std::move(planes), view.cutsCasters);
    return scene;
}

raytrace::LightSource lightSource(const DrawInputs& frame) {
    const std::optional<plan::PointLight>& lamp = frame.plan->view.pointLight;
    if (!lamp) return {frame.plan->light.unit(), false};
    return {lamp->at - frame.grid.origin - frame.grid.local(frame.space.originCell), true};
}

std::vector<raytrace::Light> lightByRays(
    const raytrace::Occluders& scene,
    const DrawInputs& frame,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels) {
    std::vector<raytrace::SurfacePoint> points(surfaces.pixels.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        const SurfaceSample& surface = surfaces.pixels[i];
        if (surface.isSurface == 0) return;
        const double pixel = pixelWidth(*frame.plan, frame.space, glm::dvec3(surface.position));
        points[i] = {surface.position, surface.normal, static_cast<float>(offsetPixels * pixel)};
    });
    std::vector<raytrace::Light> light = raytrace::litByRays(scene, points, lightSource(frame));
    // Rasterised image and rays can disagree about the lit side of a grazing surface, by the last bit of a cosine. The
    // result of the image is used.
    for (std::size_t i = 0; i < light.size(); ++i)
        if (surfaces.pixels[i].isSurface != 0 && !surfaces.pixels[i].isLitSide()) light[i] = raytrace::Light::Turned;
    return light;
}

namespace {

raytrace::CutScene cutScene(const DrawInputs& frame, raytrace::KeptTrees& trees) {
    std::vector<raytrace::PageClusters> clusters;
    for (const lod::DrawList* list : {frame.image, frame.exactCasters})
        for (const lod::ClusterRange& range : list->ranges)
            clusters.push_back({range.page, {&frame.pages(range.page), range.firstCluster, range.clusterCount}});
    return {trees, clusters, frame.grid, frame.space.originCell};
}

/// Computes the lit pixels of `frame` by ray tracing: 255 if lit, otherwise 0. The function first draws the visible
/// surfaces, and adds the number of draw calls to `drawCalls`.
Raster<std::uint8_t> litBySurfaces(Backend& backend, DrawInputs frame, std::uint64_t& drawCalls) {
    frame.wantsSurfaces = true;
    frame.wantsLight = false;
    frame.overlay = Overlay::None;
    drawCalls += backend.drawImage(frame).drawCalls;
    const Raster<SurfaceSample> surfaces = backend.surfaces();
    const std::vector<raytrace::Light> light = lightByRays(*frame.rays, frame, surfaces, kContactTolerancePixels);
    Raster<std::uint8_t> lit(surfaces.width, surfaces.height);
    for (std::size_t i = 0; i < light.size(); ++i)
        lit.pixels[i] = light[i] == raytrace::Light::Lit ? 255 : 0;
    return lit;
}

} // namespace

DrawStatistics drawByRays(Backend& backend, DrawInputs frame, raytrace::KeptTrees& trees) {
    const Stopwatch watch;
    const raytrace::CutScene scene = cutScene(frame, trees);
    frame.rays = &scene;
    const Milliseconds making = watch.elapsed();
    DrawStatistics statistics;
    if (backend.capabilities().exactShadows) {
        statistics = backend.drawExactly(frame);
        statistics.shadows.time.count += making.count;
        return statistics;
    }
    // The plan has no shadow maps, so this call only discards the maps of earlier frames.
    statistics.shadows = backend.drawShadowMaps(frame);
    const Raster<std::uint8_t> lit = litBySurfaces(backend, frame, statistics.shadows.drawCalls);
    statistics.shadows.time = watch.elapsed();
    frame.litMask = &lit;
    statistics.image = backend.drawImage(frame);
    statistics.deviceMemory = backend.deviceMemory();
    return statistics;
}

} // namespace gnomon::render
