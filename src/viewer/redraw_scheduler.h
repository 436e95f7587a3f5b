// Decides whether the window must draw another frame. After a change, the scene is drawn until the image is at rest,
// and the user interface until its layout is complete.
#pragma once

#include "telemetry/frame_row.h"

#include <algorithm>
#include <cstdint>

namespace gnomon::viewer {

/// Counts the frames of the scene and of the user interface that must still be drawn.
class RedrawScheduler {
public:
    /// Requests frames of the scene, because the view or a setting has changed.
    void requestScene() {
        sceneFrames_ = kSettlingFrames;
        framesSinceRequest_ = 0;
        millisecondsSinceRequest_ = 0;
        ++changes_;
    }

    /// Returns how many changes of the scene have been reported.
    std::uint64_t changes() const { return changes_; }

    /// Requests frames of the user interface, because its content has changed.
    void requestOverlay() { overlayFrames_ = kLayoutFrames; }

    /// Returns true if frames of the scene must still be drawn.
    bool needsScene() const { return sceneFrames_ > 0; }

    bool needsOverlay() const { return overlayFrames_ > 0; }

    /// Requests one more frame of the scene if none is requested.
    void keepScene() { sceneFrames_ = std::max(sceneFrames_, 1); }

    /// Returns true if only one more frame of the scene is requested.
    bool isLastOfScene() const { return sceneFrames_ == 1; }

    /// Removes one frame from the requested frames of the scene, after it is drawn.
    void countScene() {
        sceneFrames_ = std::max(sceneFrames_ - 1, 0);
        ++framesSinceRequest_;
    }

    /// Returns true if a frame may take longer, because nothing has changed for a while. This is the case after all but
    /// one of the settling frames. If `hurries` is true, 0.3 s of frame time are also sufficient, and the next frame is
    /// then the last one.
    bool isSettled(bool hurries) const {
        return framesSinceRequest_ >= kSettlingFrames - 1 || (hurries && millisecondsSinceRequest_ >= kSettlingMs);
    }

    /// Reduces the requested frames of the scene to at most one.
    void settle() { sceneFrames_ = std::min(sceneFrames_, 1); }

    /// Requests more frames of the scene if pages are missing in the frame of `row`, unless no page has arrived for a
    /// long time.
    void update(const telemetry::FrameRow& row);

    /// Cancels all requested frames of the scene, because the scene cannot be drawn.
    void stopScene() { sceneFrames_ = 0; }

    /// Removes one frame from the requested frames of the user interface, after it is drawn.
    void countOverlay() { overlayFrames_ = std::max(overlayFrames_ - 1, 0); }

    /// Requests one more frame of the user interface if none is requested.
    void keepOverlay() { overlayFrames_ = std::max(overlayFrames_, 1); }

private:
    // Number of frames of the scene after a change. The near end of the depth range reaches its final value in fewer
    // frames, so that the resting image has this value.
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
