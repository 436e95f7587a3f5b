#include "viewer/input/picking.h"

#include <cmath>

namespace gnomon::viewer {

std::optional<glm::ivec2> drawnPixel(const render::FloatPicture& viewDepth, const glm::ivec2& pixel, int reach) {
    std::optional<glm::ivec2> best;
    int bestDistance2 = reach * reach + 1;
    for (int y = std::max(pixel.y - reach, 0); y <= std::min(pixel.y + reach, viewDepth.height - 1); ++y)
        for (int x = std::max(pixel.x - reach, 0); x <= std::min(pixel.x + reach, viewDepth.width - 1); ++x) {
            const glm::ivec2 offset = glm::ivec2(x, y) - pixel;
            const int distance2 = offset.x * offset.x + offset.y * offset.y;
            if (distance2 >= bestDistance2 || !std::isfinite(viewDepth.at(x, y))) continue;
            bestDistance2 = distance2;
            best = glm::ivec2(x, y);
        }
    return best;
}

std::optional<glm::dvec3> pointUnder(
    const render::FloatPicture& viewDepth, const Camera& camera, const glm::ivec2& pixel, int reach) {
    const std::optional<glm::ivec2> best = drawnPixel(viewDepth, pixel, reach);
    if (!best) return std::nullopt;
    const double depth = viewDepth.at(best->x, best->y);
    const double halfHeight =
        camera.isParallel() ? halfHeightAtTarget(camera) : std::tan(camera.fovYRadians / 2) * depth;
    const double perPixel = 2 * halfHeight / viewDepth.height;
    const glm::dvec3 inCamera(
        (best->x + 0.5 - viewDepth.width * 0.5) * perPixel, (viewDepth.height * 0.5 - best->y - 0.5) * perPixel, depth);
    return camera.eye + toWorld(cameraBasis(camera), inCamera);
}

} // namespace gnomon::viewer
