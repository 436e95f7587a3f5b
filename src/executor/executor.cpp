#include "executor/executor.h"

#include "core/error.h"

namespace gnomon::executor {

DrawStatistics Executor::draw(const FrameDrawing& frame) {
    DrawStatistics statistics;
    statistics.shadows = drawShadowMaps(frame);
    statistics.image = drawImage(frame);
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

DrawStatistics Executor::drawExactly(const FrameDrawing&) {
    throw Error("exact shadows", "this executor has none", "the software rasteriser", name());
}

} // namespace gnomon::executor
