// Moves the camera by user input or by a played path. Also records paths, and stores the frozen camera of culling.
#pragma once

#include "viewer/input/camera_control.h"
#include "viewer/messages.h"
#include "viewer/path_recorder.h"
#include "viewer/saved_files.h"

#include <optional>

namespace gnomon::viewer {

/// The camera motion of a session. All functions except `enter` and the constructor need a call of `enter` before.
class Walk {
public:
    /// Creates a walk. `path` is played first, until another path is recorded. See PathPlayer for `frames`. Actions are
    /// reported in `messages`, which must outlive the object.
    Walk(Messages& messages, Clock now, std::optional<path::CameraPath> path, std::optional<int> frames)
        : messages_(&messages), now_(std::move(now)), path_(std::move(path)), frames_(frames) {}

    /// Starts at `home` in a world with this `up` axis. Throws Error, without any change, if `home` is invalid.
    void enter(const Camera& home, const glm::dvec3& up);

    bool hasEntered() const { return control_.has_value(); }

    CameraControl& control() { return *control_; }

    const CameraControl& control() const { return *control_; }

    /// Returns the camera of the image.
    Camera camera() const { return player_ ? player_->camera() : control_->camera(); }

    /// Returns the camera whose cut and maps the image uses.
    Camera culledBy() const { return frozen_.value_or(camera()); }

    bool isFrozen() const { return frozen_.has_value(); }

    bool isRecording() const { return recorder_.has_value(); }

    bool isPlaying() const { return player_.has_value(); }

    bool playsFixed() const { return player_ && player_->hasFixedStep(); }

    /// Returns true if frames are needed without input: a path plays, a recorder runs, or the camera still moves. It
    /// also works before any model.
    bool isUnderWay() const { return player_ || recorder_ || (control_ && control_->isMoving()); }

    /// Returns the played share of the path, 0 to 1, or a negative number if no path plays.
    double playedPart() const { return player_ ? player_->part() : -1; }

    /// Returns the number of the current played frame.
    int playedFrame() const { return player_->frame(); }

    void toggleFreeze();

    /// Starts a recording, or ends and saves it.
    void toggleRecording(const SavedFiles& saved);

    /// Starts playing and ends any recording, or stops playing. Returns true if a path starts.
    bool togglePlaying(const SavedFiles& saved);

    /// Adds the camera of a frame to the recording, if any.
    void record(const Camera& camera);

    /// Advances to the next frame of the path, which is `seconds` later by the clock. Returns false if the path ended.
    /// User input then moves the camera again.
    bool advance(double seconds);

    /// Ends a path at once, without a message.
    void stop() { player_.reset(); }

private:
    Messages* messages_;
    Clock now_;
    std::optional<CameraControl> control_;
    std::optional<Camera> frozen_;
    std::optional<PathRecorder> recorder_;
    std::optional<PathPlayer> player_;
    std::optional<path::CameraPath> path_;
    std::optional<int> frames_;
};

} // namespace gnomon::viewer
