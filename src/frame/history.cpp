#include "frame/history.h"

#include "plan/camera_cut.h"

namespace gnomon::frame {

History continuedHistory(const History& history, const plan::View& view, const plan::Quality& quality) {
    if (!history.previous) return history;
    const bool isContinued = plan::isSameMotion({history.view, history.quality}, {view, quality}) &&
                             !plan::isCameraCut(history.view, history.farthest, view);
    if (isContinued) return history;
    History result = history;
    result.previous = std::make_shared<const plan::PlannedFrame>(plan::PlannedFrame{history.previous->plan, {}});
    result.usesHeadlight.reset();
    return result;
}

} // namespace gnomon::frame
