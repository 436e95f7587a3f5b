#include "render/view/seen_triangles.h"

#include "hierarchy/page.h"
#include "raster/raster.h"
#include "render/view/section_caps.h"

namespace gnomon::render {

Raster<SeenTriangle> seenTriangles(
    int width, int height, std::span<const std::uint64_t> words, std::span<const DrawnCluster> drawn) {
    Raster<SeenTriangle> seen(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::uint64_t word = words[seen.index(x, height - 1 - y)];
            const std::uint32_t name = raster::visibleTriangle(word);
            if (word == 0 || isCapName(name)) continue;
            const DrawnCluster& cluster = drawn[name >> kTriangleBits];
            if (cluster.isGround) continue;
            const hierarchy::Triangle& corners = cluster.triangles[name & ((1U << kTriangleBits) - 1)];
            const auto first = static_cast<std::uint32_t>(cluster.vertices - cluster.page->vertices.data());
            seen.at(x, y) = {
                cluster.pageId, cluster.cluster, {first + corners[0], first + corners[1], first + corners[2]}};
        }
    return seen;
}

} // namespace gnomon::render
