#include "frame/exact_forecast.h"

#include "culling/frame_cut.h"
#include "frame/frame_cuts.h"

#include <algorithm>
#include <cmath>

namespace gnomon::frame {

namespace {

// An image of more triangles is drawn that much coarser, again and again.
constexpr double kCoarser = 1.5;
constexpr std::uint64_t kMostTriangles = 100000;
constexpr int kMostCoarsenings = 6;

} // namespace

double predictedErrorPixels(const plan::View& view, double errorPixels) {
    return errorPixels * (static_cast<double>(view.height) / ExactEstimate::sizeFor(view).y);
}

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
    query.errorPixels = predictedErrorPixels(view, query.errorPixels);
    selection::Cut coarse = culling::cutFrame(query);
    for (int i = 0; i < kMostCoarsenings && coarse.lists[0].triangles > kMostTriangles; ++i) {
        query.errorPixels *= kCoarser;
        coarse = culling::cutFrame(query);
    }
    executor::FrameDrawing drawn = drawing;
    drawn.image = &coarse.lists[0];
    drawn.exactCasters = &frame.cut.lists[1];
    return estimate.estimate(drawn, frame.cut.lists[0]);
}

plan::ExactWork refinedWork(const plan::ExactWork& predicted, const exact::CastForecast& forecast) {
    const auto mean = [&](double before, double now) {
        return std::pow(std::max(before, 1.0), 1 - forecast.weight) * std::pow(std::max(now, 1.0), forecast.weight);
    };
    plan::ExactWork work = predicted;
    work.castTriangles = mean(predicted.castTriangles, forecast.trianglesCast);
    work.sampleTests = mean(predicted.sampleTests, forecast.sampleTests);
    return work;
}

} // namespace gnomon::frame
