// Records camera paths in the window and plays them. A played frame is identical to the same frame of `gnomon bench`.
#pragma once

#include "path/camera_path.h"

#include <optional>

namespace gnomon::viewer {

/// Records the camera of the user as keyframes of a camera path.
class PathRecorder {
public:
    /// Records that the camera is `camera` at the time `seconds`, which must not decrease. The recorder stores at most
    /// thirty keyframes per second, and only the first and the last keyframe of a resting camera.
    void add(double seconds, const Camera& camera);

    /// Returns the camera path recorded so far, with its first keyframe at time 0. Returns nullopt before the first
    /// camera.
    std::optional<path::CameraPath> path() const;

private:
    path::CameraPath path_;
    std::optional<path::Keyframe> last_; // the latest keyframe, not in the path yet
};

/// Plays a camera path, either in real time or in a fixed number of frames.
class PathPlayer {
public:
    /// Creates a player. With `frames`, it plays this number of frames, evenly spaced over the path like in a bench.
    /// Without `frames`, it plays in real time.
    PathPlayer(path::CameraPath path, std::optional<int> frames) : path_(std::move(path)), frames_(frames) {}

    /// Returns the camera of the path at the current frame.
    Camera camera() const;

    /// Returns the number of the current frame of the path, from 0. In real time, this is the number of drawn frames.
    int frame() const { return frame_; }

    bool hasFixedStep() const { return frames_.has_value(); }

    /// Advances to the next frame of the path. In real time, this frame is `seconds` later. Returns false at the end of
    /// the path.
    bool advance(double seconds);

    /// Returns the fraction of the path that has been played, 0 to 1.
    double part() const;

private:
    double time() const;

    path::CameraPath path_;
    std::optional<int> frames_;
    int frame_ = 0;
    double seconds_ = 0;
};

} // namespace gnomon::viewer
