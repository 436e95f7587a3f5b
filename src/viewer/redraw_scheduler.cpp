#include "viewer/redraw_scheduler.h"

namespace gnomon::viewer {

void RedrawScheduler::update(const telemetry::FrameRow& row) {
    millisecondsSinceRequest_ += row.totalMs.value_or(0);
    const std::int64_t bytesRead = row.bytesRead.value_or(0);
    unanswered_ = bytesRead != bytesRead_ ? 0 : unanswered_ + 1;
    bytesRead_ = bytesRead;
    if (row.pagesMissing.value_or(0) > 0 && unanswered_ < kUnansweredFrames) sceneFrames_ = std::max(sceneFrames_, 2);
}

} // namespace gnomon::viewer
