// Moves the camera of the window by user input or by a played camera path. Also records paths, and stores the camera
// whose culling the user has frozen.
#pragma once

#include "viewer/input/camera_control.h"
#include "viewer/messages.h"
#include "viewer/path_recorder.h"
#include "viewer/saved_files.h"

#include <optional>

namespace gnomon::viewer {

/// The motion of the camera during a window session. `enter` must be called before all other functions.
class Walk {
public:
    /// Creates a motion without a camera. `path` is played first, until another path is recorded. See PathPlayer for
    /// `frames`. Actions are reported in `messages`, which must outlive the object.
    Walk(Messages& messages, Clock now, std::optional<path::CameraPath> path, std::optional<int> frames)
        : messages_(&messages), now_(std::move(now)), path_(std::move(path)), frames_(frames) {}

    /// Moves the camera to `home`, in a world whose up direction is `up`. If `home` is invalid, throws Error and
    /// changes nothing.
    void enter(const Camera& home, const glm::dvec3& up);

    bool hasEntered() const { return control_.has_value(); }

    CameraControl& control() { return *control_; }

    const CameraControl& control() const { return *control_; }

    /// Returns the camera of the image.
    Camera camera() const { return player_ ? player_->camera() : control_->camera(); }

    /// Returns the camera for which clusters are culled and shadow maps are drawn. If the user has frozen culling, it
    /// is the camera of that moment, else the camera of the image.
    Camera culledBy() const { return frozen_.value_or(camera()); }

    bool isFrozen() const { return frozen_.has_value(); }

    bool isRecording() const { return recorder_.has_value(); }

    bool isPlaying() const { return player_.has_value(); }

    bool playsFixed() const { return player_ && player_->hasFixedStep(); }

    /// Returns true if frames are needed without user input: a path plays, a recorder runs, or the camera still moves.
    /// It can also be called before `enter`.
    bool isUnderWay() const { return player_ || recorder_ || (control_ && control_->isMoving()); }

    /// Returns the fraction of the camera path that has been played, 0 to 1, or a negative number if no path plays.
    double playedPart() const { return player_ ? player_->part() : -1; }

    /// Returns the number of the current frame of the played camera path.
    int playedFrame() const { return player_->frame(); }

    void toggleFreeze();

    /// Starts the recording of a camera path. If a recording runs, ends it and saves the path.
    void toggleRecording(const SavedFiles& saved);

    /// Starts to play the camera path and ends any recording. If a path plays already, stops it. Returns true if a path
    /// starts.
    bool togglePlaying(const SavedFiles& saved);

    /// Adds the camera of a frame to the recorded path, if a recording runs.
    void record(const Camera& camera);

    /// Advances to the next frame of the played path. In real time, this frame is `seconds` later. Returns false if the
    /// path has ended, so that user input moves the camera again.
    bool advance(double seconds);

    /// Stops the played camera path at once, without a message.
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
