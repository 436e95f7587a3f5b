#include "viewer/walk.h"

namespace gnomon::viewer {

void Walk::enter(const Camera& home, const glm::dvec3& up) {
    control_ = CameraControl(home, up);
    frozen_.reset();
    player_.reset();
    recorder_.reset();
}

void Walk::toggleFreeze() {
    if (frozen_)
        frozen_.reset();
    else
        frozen_ = control_->camera();
    messages_->show(frozen_ ? "culling is frozen: walk around it" : "culling follows the camera");
}

void Walk::toggleRecording(const SavedFiles& saved) {
    if (!recorder_) {
        recorder_.emplace();
        record(control_->camera());
        return messages_->show("recording: R ends it");
    }
    const std::optional<path::CameraPath> path = recorder_->path();
    recorder_.reset();
    if (!path) return;
    path_ = path;
    messages_->attempt([&] { messages_->note("saved " + saved.savePath(*path)); });
}

bool Walk::togglePlaying(const SavedFiles& saved) {
    if (player_) {
        control_->jumpTo(player_->camera());
        player_.reset();
        messages_->show("path: stopped");
        return false;
    }
    if (!path_) {
        messages_->show("no path yet: R records one");
        return false;
    }
    if (recorder_) toggleRecording(saved);
    player_.emplace(*path_, frames_);
    return true;
}

void Walk::record(const Camera& camera) {
    if (recorder_) recorder_->add(now_(), camera);
}

bool Walk::advance(double seconds) {
    if (!player_) return true;
    const Camera last = player_->camera();
    if (player_->advance(seconds)) return true;
    player_.reset();
    control_->jumpTo(last);
    messages_->note("path: played to its end");
    return false;
}

} // namespace gnomon::viewer
