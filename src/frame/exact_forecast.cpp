#include "frame/exact_forecast.h"

#include "culling/frame_cut.h"
#include "frame/frame_cuts.h"

namespace gnomon::frame {

namespace {

// The points of the small image need not be better than this: places within some of its pixels do as well.
constexpr double kCoarser = 4;
constexpr std::uint64_t kMostTriangles = 40000;
constexpr int kMostCoarsenings = 3;

} // namespace

plan::ExactWork predictedWork(
    const PreparedFrame& frame,
    const executor::FrameDrawing& drawing,
    const Residency& residency,
    ExactEstimate& estimate) {
    if (!frame.isExact()) return {};
    const plan::View& view = frame.plan.view;
    const selection::ErrorRule rule(frame.rule->view());
    selection::CutQuery query = cutQuery(residency, frame);
    query.rule = &rule;
    query.volumes = query.volumes.first(1);
    query.errorPixels *= kCoarser * static_cast<double>(view.height) / ExactEstimate::sizeFor(view).y;
    selection::Cut coarse = culling::cutFrame(query);
    for (int i = 0; i < kMostCoarsenings && coarse.lists[0].triangles > kMostTriangles; ++i) {
        query.errorPixels *= kCoarser;
        coarse = culling::cutFrame(query);
    }
    executor::FrameDrawing drawn = drawing;
    drawn.image = &coarse.lists[0];
    drawn.exactCasters = &frame.cut.lists[1];
    return estimate.estimate(drawn);
}

} // namespace gnomon::frame
