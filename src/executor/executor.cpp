#include "executor/executor.h"

namespace gnomon::executor {

DrawStatistics Executor::draw(const FrameDrawing& frame) {
    DrawStatistics statistics;
    statistics.shadows = drawShadowMaps(frame);
    statistics.image = drawImage(frame);
    statistics.deviceMemory = deviceMemory();
    return statistics;
}

} // namespace gnomon::executor
