#include "render/image_pass.h"

#include "render/frame_block.h"
#include "render/view/section_caps.h"
#include "render/view/section_memory.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>

namespace gnomon::render {

std::optional<raster::OcclusionCounts> drawVisible(const DrawInputs& frame, const ImageBuffers& buffers) {
    const plan::View& view = frame.plan->view;
    SoftwarePass& pass = *buffers.pass;
    pass.gather(frame, *frame.image, Cutting::BySections);
    if (frame.ground != nullptr) pass.addGround(*frame.ground);
    const raster::View seen = rasterView(frame.space, imageClipFromDraw(frame), {0, 0, view.width, view.height});
    const ImageRows rows = rowsOf(frame);
    raster::VisibilityTarget target{buffers.words->data(), view.width, rows.count};
    target.firstRow = rows.first;
    if (frame.tiles != nullptr)
        target.isWanted = [&tiles = *frame.tiles](const raster::PixelBox& box) {
            return tiles.holdsAny(box.x0, box.y0, box.x1, box.y1);
        };
    std::optional<raster::OcclusionCounts> hidden;
    // The search for section lines runs in parallel with the other work, because the search itself is hard to
    // parallelise.
    tbb::task_group lines;
    if (!frame.sections.empty()) lines.run([&] { frame.sectionMemory->lines.find(frame); });
    if (frame.plan->skipsHidden)
        hidden = buffers.rasterizer->drawVisible(pass.clusters(), pass.boxes(), seen, target);
    else
        buffers.rasterizer->drawVisibility(pass.clusters(), seen, target);
    lines.wait();
    if (!frame.sections.empty()) drawCaps(frame, *buffers.words);
    return hidden;
}

namespace {

/// Shades the tiles in `square` that the target requests. The corner of the square is the corner of a tile.
void shadeTiles(
    const Shading& shading,
    const raster::PixelBox& square,
    std::span<const std::uint64_t> words,
    const ShadingTarget& target) {
    constexpr int kSide = shadow::ImageTiles::kSide;
    for (int y = square.y0; y < square.y1; y += kSide)
        for (int x = square.x0; x < square.x1; x += kSide)
            if (target.tiles->holds(x, y))
                shading.shade({x, y, std::min(square.x1, x + kSide), std::min(square.y1, y + kSide)}, words, target);
}

} // namespace

void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target) {
    // The image is divided into squares, because neighbouring pixels in both directions often show the same triangle.
    // The squares are small enough for load balancing.
    constexpr int kSide = 2 * shadow::ImageTiles::kSide;
    const Picture& picture = *target.picture;
    const ImageRows held = shading.rows();
    const int columns = (picture.width + kSide - 1) / kSide;
    const int rows = (held.count + kSide - 1) / kSide;
    tbb::parallel_for(0, columns * rows, [&](int i) {
        const int x = i % columns * kSide;
        const int y = held.first + i / columns * kSide;
        const raster::PixelBox square{
            x, y, std::min(picture.width, x + kSide), std::min(held.first + held.count, y + kSide)};
        if (target.tiles == nullptr)
            shading.shade(square, words, target);
        else
            shadeTiles(shading, square, words, target);
    });
}

} // namespace gnomon::render
