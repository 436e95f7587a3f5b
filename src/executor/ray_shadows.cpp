#include "executor/ray_shadows.h"

#include "core/stopwatch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace gnomon::executor {

std::vector<selection::ClusterRange> distinctClusters(std::span<const selection::DrawList* const> lists) {
    // Each range is one cluster, so that duplicates in overlapping lists can be removed.
    std::vector<selection::ClusterRange> clusters;
    for (const selection::DrawList* list : lists)
        for (const selection::ClusterRange& range : list->ranges)
            for (std::uint32_t c = 0; c < range.clusterCount; ++c)
                clusters.push_back({range.page, range.firstCluster + c, 1});
    std::sort(clusters.begin(), clusters.end());
    clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
    return clusters;
}

raycast::Scene rayScene(const FrameDrawing& frame, std::span<const selection::DrawList* const> lists) {
    const std::vector<selection::ClusterRange> clusters = distinctClusters(lists);
    std::vector<raycast::ClusterSpan> spans;
    spans.reserve(clusters.size());
    for (const selection::ClusterRange& cluster : clusters)
        spans.push_back({&frame.pages(cluster.page), cluster.firstCluster, 1});
    raycast::Scene scene(spans, frame.grid, frame.grid.local(frame.space.originCell));
    const plan::View& view = frame.plan->view;
    if (view.sections.empty()) return scene;
    std::vector<Plane> planes;
    for (const Plane& plane : view.sections)
        planes.push_back({plane.normal, plane.signedDistance(frame.grid.world(frame.space.originCell))});
    scene.cutBy(std::move(planes), view.cutsCasters);
    return scene;
}

raycast::LightSource lightSource(const FrameDrawing& frame) {
    const std::optional<plan::PointLight>& lamp = frame.plan->view.pointLight;
    if (!lamp) return {frame.plan->light.unit(), false};
    return {lamp->at - frame.grid.origin - frame.grid.local(frame.space.originCell), true};
}

std::vector<raycast::Light> lightByRays(
    const raycast::Occluders& scene,
    const FrameDrawing& frame,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels) {
    std::vector<raycast::SurfacePoint> points(surfaces.pixels.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        const SurfaceSample& surface = surfaces.pixels[i];
        if (surface.isSurface == 0) return;
        const double pixel = pixelWidth(*frame.plan, frame.space, glm::dvec3(surface.position));
        points[i] = {surface.position, surface.normal, static_cast<float>(offsetPixels * pixel)};
    });
    std::vector<raycast::Light> light = raycast::litByRays(scene, points, lightSource(frame));
    // Image and rays can disagree about the side of a grazing surface, by the last bit of a cosine. The image decides.
    for (std::size_t i = 0; i < light.size(); ++i)
        if (surfaces.pixels[i].isSurface != 0 && !surfaces.pixels[i].isLitSide()) light[i] = raycast::Light::Turned;
    return light;
}

namespace {

raycast::CutScene cutScene(const FrameDrawing& frame, raycast::KeptTrees& trees) {
    std::vector<raycast::PageClusters> clusters;
    for (const selection::DrawList* list : {frame.image, frame.exactCasters})
        for (const selection::ClusterRange& range : list->ranges)
            clusters.push_back({range.page, {&frame.pages(range.page), range.firstCluster, range.clusterCount}});
    return {trees, clusters, frame.grid, frame.space.originCell};
}

/// Returns the lit pixels of `frame`: 255 if lit, otherwise 0. Draws the surfaces and adds the draw calls to
/// `drawCalls`.
Raster<std::uint8_t> litBySurfaces(Executor& executor, FrameDrawing frame, std::uint64_t& drawCalls) {
    frame.wantsSurfaces = true;
    frame.wantsLight = false;
    frame.overlay = Overlay::None;
    drawCalls += executor.drawImage(frame).drawCalls;
    const Raster<SurfaceSample> surfaces = executor.surfaces();
    const std::vector<raycast::Light> light = lightByRays(*frame.rays, frame, surfaces, kTouchingPixels);
    Raster<std::uint8_t> lit(surfaces.width, surfaces.height);
    for (std::size_t i = 0; i < light.size(); ++i)
        lit.pixels[i] = light[i] == raycast::Light::Lit ? 255 : 0;
    return lit;
}

} // namespace

DrawStatistics drawByRays(Executor& executor, FrameDrawing frame, raycast::KeptTrees& trees) {
    const Stopwatch watch;
    const raycast::CutScene scene = cutScene(frame, trees);
    frame.rays = &scene;
    const Milliseconds making = watch.elapsed();
    DrawStatistics statistics;
    if (executor.capabilities().exactShadows) {
        statistics = executor.drawExactly(frame);
        statistics.shadows.time.count += making.count;
        return statistics;
    }
    statistics.shadows = executor.drawShadowMaps(frame); // without maps, this only discards the maps of earlier frames
    const Raster<std::uint8_t> lit = litBySurfaces(executor, frame, statistics.shadows.drawCalls);
    statistics.shadows.time = watch.elapsed();
    frame.litMask = &lit;
    statistics.image = executor.drawImage(frame);
    statistics.deviceMemory = executor.deviceMemory();
    return statistics;
}

} // namespace gnomon::executor
