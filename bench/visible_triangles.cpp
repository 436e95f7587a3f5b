// Counts the triangles that the rasteriser processes per visible triangle, with occlusion culling.
//
// usage: visible_triangles MODEL.gnm PATH.json FRAMES [WIDTHxHEIGHT]
//
// The program draws FRAMES frames along a camera path, without shadows (default size: 800x800). It prints one CSV row
// per frame:
// - clusters, triangles: selected clusters of the image, and their triangles
// - clusters_hidden: clusters that occlusion culling skips
// - triangles_not_hidden: triangles of the other clusters
// - triangles_set_up: triangles whose edge functions the rasteriser computes
// - triangles_seen: triangles that are visible in at least one pixel
//
// The last line states two ratios over all frames. They are the sums of triangles_not_hidden and of triangles_set_up,
// each divided by the sum of triangles_seen.
#include "frame/renderer.h"
#include "path/camera_path.h"
#include "render/image_pass.h"
#include "render/software_backend.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace gnomon {
namespace {

int run(const char* model, const char* pathName, int frames, int width, int height) {
    const hierarchy::ModelFile file(model, gibibytes(1));
    const path::CameraPath path = path::readCameraPath(pathName);
    const auto software = render::makeSoftwareBackend();
    frame::Renderer renderer(file, *software, {});
    raster::Rasterizer rasterizer;
    render::SoftwarePass pass;
    render::Picture picture(width, height);
    std::vector<std::uint64_t> words(picture.pixels.size());
    std::uint64_t drawnSum = 0;
    std::uint64_t setUpSum = 0;
    std::uint64_t seenSum = 0;
    std::printf("frame,clusters,clusters_hidden,triangles,triangles_not_hidden,triangles_set_up,triangles_seen\n");
    for (int i = 0; i < frames; ++i) {
        plan::View view;
        view.camera = path::cameraAt(path, path::frameTime(path, i, frames));
        view.width = width;
        view.height = height;
        plan::Quality quality;
        quality.shadows = plan::ShadowMode::Off;
        quality.occlusion = plan::Choice::On;
        const frame::PreparedFrame prepared = renderer.prepare(view, quality);
        const auto hidden = render::drawVisible(renderer.drawing(prepared, {}), {&rasterizer, &pass, &words, &picture});
        std::vector<std::uint32_t> names;
        for (const std::uint64_t word : words)
            if (word != 0) names.push_back(raster::visibleTriangle(word));
        std::sort(names.begin(), names.end());
        const auto seen = static_cast<std::uint64_t>(std::unique(names.begin(), names.end()) - names.begin());
        const lod::DrawList& image = prepared.cut.lists.image;
        std::printf(
            "%d,%llu,%llu,%llu,%llu,%llu,%llu\n",
            i,
            static_cast<unsigned long long>(image.clusters),
            static_cast<unsigned long long>(hidden->clustersHidden),
            static_cast<unsigned long long>(image.triangles),
            static_cast<unsigned long long>(image.triangles - hidden->trianglesHidden),
            static_cast<unsigned long long>(hidden->trianglesSetUp),
            static_cast<unsigned long long>(seen));
        drawnSum += image.triangles - hidden->trianglesHidden;
        setUpSum += hidden->trianglesSetUp;
        seenSum += seen;
    }
    const auto perSeen = [&](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(seenSum); };
    std::printf(
        "in clusters not hidden over seen: %.2f, set up over seen: %.2f\n", perSeen(drawnSum), perSeen(setUpSum));
    return 0;
}

} // namespace
} // namespace gnomon

int main(int count, char** arguments) {
    int width = 800;
    int height = 800;
    if (count < 4 || (count > 4 && std::sscanf(arguments[4], "%dx%d", &width, &height) != 2)) {
        std::fprintf(stderr, "usage: visible_triangles MODEL.gnm PATH.json FRAMES [WIDTHxHEIGHT]\n");
        return 2;
    }
    return gnomon::run(arguments[1], arguments[2], std::atoi(arguments[3]), width, height);
}
