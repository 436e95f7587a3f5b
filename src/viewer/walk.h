// What moves the camera: user input, or a path that is played; with the recorder of that input, and the eye that
// culling may stay frozen to.
#pragma once

#include "viewer/input/camera_control.h"
#include "viewer/messages.h"
#include "viewer/path_recorder.h"
#include "viewer/saved_files.h"

#include <optional>

namespace gnomon::viewer {

/// Everything but `enter` and the constructor needs a model that was entered.
class Walk {
public:
    /// `path` is what is played first, until another one is recorded; `frames` as in PathPlayer. What is done is told
    /// in `messages`, which must outlive it.
    Walk(Messages& messages, Clock now, std::optional<path::CameraPath> path, std::optional<int> frames)
        : messages_(&messages), now_(std::move(now)), path_(std::move(path)), frames_(frames) {}

    /// Begins at `home` in a world with this `up`. Throws Error if `home` is impossible; then all stays as it was.
    void enter(const Camera& home, const glm::dvec3& up);

    bool hasEntered() const { return control_.has_value(); }

    CameraControl& control() { return *control_; }

    const CameraControl& control() const { return *control_; }

    /// Who sees the picture.
    Camera camera() const { return player_ ? player_->camera() : control_->camera(); }

    /// Whose cut and maps the picture is made of.
    Camera culledBy() const { return frozen_.value_or(camera()); }

    bool isFrozen() const { return frozen_.has_value(); }

    bool isRecording() const { return recorder_.has_value(); }

    bool isPlaying() const { return player_.has_value(); }

    bool playsFixed() const { return player_ && player_->hasFixedStep(); }

    /// Whether the next frame is another one, or has to be drawn for a recorder, though nobody touches anything; also
    /// before any model.
    bool isUnderWay() const { return player_ || recorder_ || (control_ && control_->isMoving()); }

    /// How much of the path that is played is behind, 0 to 1; below 0 where none is.
    double playedPart() const { return player_ ? player_->part() : -1; }

    /// The number of the played frame at hand.
    int playedFrame() const { return player_->frame(); }

    void toggleFreeze();

    /// Begins to record, or ends and saves what was recorded.
    void toggleRecording(const SavedFiles& saved);

    /// Begins to play, ending any recording, or stops. Whether a path begins.
    bool togglePlaying(const SavedFiles& saved);

    /// Adds the camera of a frame to what is recorded, if anything is.
    void record(const Camera& camera);

    /// On to the next frame of the path, which is `seconds` later by the clock. False where that ended the path, so
    /// that user input moves the camera again.
    bool advance(double seconds);

    /// Ends a path at once, without a word.
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
