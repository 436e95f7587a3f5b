// The redraw scheduler of the window. It draws the scene until the image is at rest after a change, and the overlay
// until its layout is complete.
#pragma once

#include "telemetry/frame_row.h"

#include <algorithm>
#include <cstdint>

namespace gnomon::viewer {

/// The number of frames that the scene and the overlay still need.
class RedrawScheduler {
public:
    /// Requests scene frames after a change.
    void requestScene() {
        sceneFrames_ = kSettlingFrames;
        framesSinceRequest_ = 0;
        millisecondsSinceRequest_ = 0;
        ++changes_;
    }

    /// Returns the number of changes so far.
    std::uint64_t changes() const { return changes_; }

    /// Requests overlay frames after a change of the overlay.
    void requestOverlay() { overlayFrames_ = kLayoutFrames; }

    /// Returns true if scene frames are pending.
    bool needsScene() const { return sceneFrames_ > 0; }

    bool needsOverlay() const { return overlayFrames_ > 0; }

    /// Requests one more scene frame if none is pending.
    void keepScene() { sceneFrames_ = std::max(sceneFrames_, 1); }

    /// Returns true if the next scene frame is the last one that is requested so far.
    bool isLastOfScene() const { return sceneFrames_ == 1; }

    /// Counts a drawn scene frame.
    void countScene() {
        sceneFrames_ = std::max(sceneFrames_ - 1, 0);
        ++framesSinceRequest_;
    }

    /// Returns true if a frame may take longer, because nothing has changed for a while: for all but one of the
    /// settling frames, or for 0.3 s of frame time if `hurries` is true. In the second case the next frame is the last
    /// one.
    bool isSettled(bool hurries) const {
        return framesSinceRequest_ >= kSettlingFrames - 1 || (hurries && millisecondsSinceRequest_ >= kSettlingMs);
    }

    /// Skips the pending scene frames before the last one.
    void settle() { sceneFrames_ = std::min(sceneFrames_, 1); }

    /// Processes the result of a scene frame. If pages are missing, it requests more frames, unless no page has arrived
    /// for a long time.
    void update(const telemetry::FrameRow& row);

    /// Cancels scene frames, because the scene cannot be drawn.
    void stopScene() { sceneFrames_ = 0; }

    /// Counts a drawn overlay frame.
    void countOverlay() { overlayFrames_ = std::max(overlayFrames_ - 1, 0); }

    /// Requests one more overlay frame if none is pending.
    void keepOverlay() { overlayFrames_ = std::max(overlayFrames_, 1); }

private:
    // Number of frames after a change. The near end of the depth range reaches its final value in fewer frames, so that
    // the resting image has this value.
    static constexpr int kSettlingFrames = 16;
    static constexpr double kSettlingMs = 300;
    static constexpr int kUnansweredFrames = 60; // max consecutive frames with missing pages if no page arrives
    static constexpr int kLayoutFrames = 3;      // Dear ImGui needs several frames to lay out new content

    int sceneFrames_ = kSettlingFrames;
    int overlayFrames_ = kLayoutFrames;
    int framesSinceRequest_ = 0;
    double millisecondsSinceRequest_ = 0;
    std::uint64_t changes_ = 0;
    int unanswered_ = 0;
    std::int64_t bytesRead_ = 0;
};

} // namespace gnomon::viewer
