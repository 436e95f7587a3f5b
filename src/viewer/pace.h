// When the window draws: the scene until it has come to rest after a change, and what lies over it until that is laid
// out.
#pragma once

#include "telemetry/frame_row.h"

#include <algorithm>
#include <cstdint>

namespace gnomon::viewer {

class Pace {
public:
    /// Something has changed that the next frames of the scene must show.
    void wakeScene() {
        sceneFrames_ = kSettlingFrames;
        framesSinceWoken_ = 0;
        millisecondsSinceWoken_ = 0;
        ++changes_;
    }

    /// How often something has changed so far.
    std::uint64_t changes() const { return changes_; }

    /// Something has changed in what lies over the scene.
    void wakeWindow() { windowFrames_ = kLayoutFrames; }

    /// Whether there are frames of the scene to be drawn.
    bool isSceneAwake() const { return sceneFrames_ > 0; }

    bool isWindowAwake() const { return windowFrames_ > 0; }

    /// The scene is to be drawn at least once more.
    void keepScene() { sceneFrames_ = std::max(sceneFrames_, 1); }

    /// Whether only one more frame of the scene is to be drawn, as far as is known.
    bool isLastOfScene() const { return sceneFrames_ == 1; }

    /// The scene is drawn once more.
    void countScene() {
        sceneFrames_ = std::max(sceneFrames_ - 1, 0);
        ++framesSinceWoken_;
    }

    /// Whether nothing has changed for so long that frames may take their time: for all but one of the frames until the
    /// scene has come to rest, or for 0.3 s of frames where it `hurries`, whose next frame is then the last.
    bool isSettled(bool hurries) const {
        return framesSinceWoken_ >= kSettlingFrames - 1 || (hurries && millisecondsSinceWoken_ >= kSettlingMs);
    }

    /// Leaves out what is to be drawn of the scene before its last frame.
    void settle() { sceneFrames_ = std::min(sceneFrames_, 1); }

    /// Takes in what became of a frame of the scene. Pages on their way will change the picture, unless nothing has
    /// come for long.
    void see(const telemetry::FrameRow& row);

    /// The scene cannot be drawn.
    void stopScene() { sceneFrames_ = 0; }

    /// The window is drawn once more.
    void countWindow() { windowFrames_ = std::max(windowFrames_ - 1, 0); }

    /// What lies over the scene is to be drawn at least once more.
    void keepWindow() { windowFrames_ = std::max(windowFrames_, 1); }

private:
    static constexpr int kSettlingFrames = 16; // more than near takes to rise: what it was held at is not shown at rest
    static constexpr double kSettlingMs = 300;
    static constexpr int kUnansweredFrames = 60; // with pages missing of which none comes
    static constexpr int kLayoutFrames = 3;      // Dear ImGui needs more than one to lay out what is new

    int sceneFrames_ = kSettlingFrames;
    int windowFrames_ = kLayoutFrames;
    int framesSinceWoken_ = 0;
    double millisecondsSinceWoken_ = 0;
    std::uint64_t changes_ = 0;
    int unanswered_ = 0;
    std::int64_t bytesRead_ = 0;
};

} // namespace gnomon::viewer
