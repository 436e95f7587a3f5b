#include "executor/image_pass.h"

#include "executor/frame_block.h"
#include "executor/view/section_caps.h"
#include "executor/view/section_memory.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>

namespace gnomon::executor {

std::optional<raster::OcclusionCounts> drawVisible(const FrameDrawing& frame, const ImageBuffers& buffers) {
    const plan::View& view = frame.plan->view;
    SoftwarePass& pass = *buffers.pass;
    pass.gather(frame, *frame.image, Cutting::BySections);
    if (frame.ground != nullptr) pass.addGround(*frame.ground);
    const raster::View seen = rasterView(frame.space, imageClipFromDraw(frame), {0, 0, view.width, view.height});
    const raster::VisibilityTarget target{buffers.words->data(), view.width, view.height};
    std::optional<raster::OcclusionCounts> hidden;
    tbb::task_group lines; // finding them is hard to share out
    if (!frame.sections.empty()) lines.run([&] { frame.sectionMemory->lines.find(frame); });
    if (frame.plan->skipsHidden)
        hidden = buffers.rasterizer->drawVisible(pass.clusters(), pass.boxes(), seen, target);
    else
        buffers.rasterizer->drawVisibility(pass.clusters(), seen, target);
    lines.wait();
    if (!frame.sections.empty()) drawCaps(frame, *buffers.words);
    return hidden;
}

void shadeVisible(const Shading& shading, std::span<const std::uint64_t> words, const ShadingTarget& target) {
    // Squares, since neighbours in both directions see the same triangles; small enough to share out evenly.
    constexpr int kSide = 64;
    const Picture& picture = *target.picture;
    const int columns = (picture.width + kSide - 1) / kSide;
    const int rows = (picture.height + kSide - 1) / kSide;
    tbb::parallel_for(0, columns * rows, [&](int i) {
        const int x = i % columns * kSide;
        const int y = i / columns * kSide;
        shading.shade({x, y, std::min(picture.width, x + kSide), std::min(picture.height, y + kSide)}, words, target);
    });
}

} // namespace gnomon::executor
