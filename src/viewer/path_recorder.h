// Camera paths made by hand and walked again: the recorder, and the player whose frames are those of a bench.
#pragma once

#include "path/camera_path.h"

#include <optional>

namespace gnomon::viewer {

/// Collects the cameras of a walk by hand.
class PathRecorder {
public:
    /// Adds `camera` at `seconds`, which must not decrease. At most thirty keyframes a second are kept, and of a
    /// camera that stands still only its first and its last.
    void add(double seconds, const Camera& camera);

    /// The path so far, its first keyframe at time 0; nothing before the first camera.
    std::optional<path::CameraPath> path() const;

private:
    path::CameraPath path_;
    std::optional<path::Keyframe> last_; // not yet in the path
};

/// Walks a path, either by the clock or in a fixed number of frames.
class PathPlayer {
public:
    /// `frames` at a fixed step, evenly over the path as in a bench; nothing: by the clock.
    PathPlayer(path::CameraPath path, std::optional<int> frames) : path_(std::move(path)), frames_(frames) {}

    /// The camera of the frame at hand.
    Camera camera() const;

    /// Its number, from 0; by the clock it counts frames drawn.
    int frame() const { return frame_; }

    bool hasFixedStep() const { return frames_.has_value(); }

    /// On to the next frame, which is `seconds` later by the clock. False when the path was over.
    bool advance(double seconds);

    /// How much of the path is behind, 0 to 1.
    double part() const;

private:
    double time() const;

    path::CameraPath path_;
    std::optional<int> frames_;
    int frame_ = 0;
    double seconds_ = 0;
};

} // namespace gnomon::viewer
