// The recorder of camera paths, and the player. A played frame is identical to the same frame of a bench.
#pragma once

#include "path/camera_path.h"

#include <optional>

namespace gnomon::viewer {

/// Records the cameras of a walk.
class PathRecorder {
public:
    /// Adds `camera` at `seconds`, which must not decrease. The recorder stores at most thirty keyframes per second,
    /// and only the first and the last keyframe of a resting camera.
    void add(double seconds, const Camera& camera);

    /// Returns the path so far, with its first keyframe at time 0. Returns nothing before the first camera.
    std::optional<path::CameraPath> path() const;

private:
    path::CameraPath path_;
    std::optional<path::Keyframe> last_; // the latest keyframe, not in the path yet
};

/// Plays a path, either by the clock or in a fixed number of frames.
class PathPlayer {
public:
    /// Creates a player with `frames` frames at a fixed step, evenly spaced over the path like in a bench. Without
    /// `frames` it plays by the clock.
    PathPlayer(path::CameraPath path, std::optional<int> frames) : path_(std::move(path)), frames_(frames) {}

    /// Returns the camera of the current frame.
    Camera camera() const;

    /// Returns the number of the current frame, from 0. By the clock it counts drawn frames.
    int frame() const { return frame_; }

    bool hasFixedStep() const { return frames_.has_value(); }

    /// Advances to the next frame, which is `seconds` later by the clock. Returns false at the end of the path.
    bool advance(double seconds);

    /// Returns the played share of the path, 0 to 1.
    double part() const;

private:
    double time() const;

    path::CameraPath path_;
    std::optional<int> frames_;
    int frame_ = 0;
    double seconds_ = 0;
};

} // namespace gnomon::viewer
