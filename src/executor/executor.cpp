#include "executor/executor.h"

#include "core/error.h"

namespace gnomon::executor {

DrawStatistics Executor::drawExactly(const FrameDrawing&) {
    throw Error("exact shadows", "this executor has none", "the software rasteriser", name());
}

} // namespace gnomon::executor
