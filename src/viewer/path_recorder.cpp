#include "viewer/path_recorder.h"

#include <algorithm>

namespace gnomon::viewer {

namespace {

constexpr double kMinInterval = 1.0 / 30; // seconds

bool isSame(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fovYRadians == b.fovYRadians &&
           a.projection == b.projection;
}

} // namespace

void PathRecorder::add(double seconds, const Camera& camera) {
    const path::Keyframe now{seconds, camera};
    std::vector<path::Keyframe>& kept = path_.keyframes;
    if (kept.empty()) {
        kept.push_back(now);
        return;
    }
    const bool stood = isSame(kept.back().camera, last_ ? last_->camera : kept.back().camera);
    const bool stands = isSame(kept.back().camera, camera);
    // The camera has rested until now. The end of the rest also becomes a keyframe, so that the interpolated camera
    // does not move earlier.
    if (last_ && stood && !stands) kept.push_back(*last_);
    last_ = now;
    if (!stands && seconds - kept.back().time >= kMinInterval) {
        kept.push_back(now);
        last_.reset();
    }
}

std::optional<path::CameraPath> PathRecorder::path() const {
    if (path_.keyframes.empty()) return std::nullopt;
    path::CameraPath result = path_;
    if (last_) result.keyframes.push_back(*last_);
    const double start = result.keyframes.front().time;
    for (path::Keyframe& keyframe : result.keyframes)
        keyframe.time -= start;
    return result;
}

double PathPlayer::time() const {
    if (frames_) return path::frameTime(path_, frame_, *frames_);
    return path_.keyframes.front().time + std::min(seconds_, path_.duration());
}

Camera PathPlayer::camera() const {
    return path::cameraAt(path_, time());
}

bool PathPlayer::advance(double seconds) {
    ++frame_;
    seconds_ += seconds;
    return frames_ ? frame_ < *frames_ : seconds_ < path_.duration();
}

double PathPlayer::part() const {
    const double duration = path_.duration();
    return duration > 0 ? (time() - path_.keyframes.front().time) / duration : 1;
}

} // namespace gnomon::viewer
