#include "frame/exact_forecast.h"

namespace gnomon::frame {

plan::ExactWork predictedWork(const PreparedFrame& frame) {
    plan::ExactWork work;
    if (!frame.isExact()) return work;
    // Means over views of six models; of a pixel, of a caster's triangle, and of one that is cast.
    constexpr double kLitShare = 0.35;
    constexpr double kCastShare = 0.4;
    constexpr double kTestsPerTriangle = 40;
    const plan::View& view = frame.plan.view;
    work.samples = kLitShare * static_cast<double>(view.width) * static_cast<double>(view.height);
    work.casterTriangles = static_cast<double>(frame.cut.lists[1].triangles);
    work.castTriangles = kCastShare * work.casterTriangles;
    work.sampleTests = kTestsPerTriangle * work.castTriangles;
    return work;
}

} // namespace gnomon::frame
