// Camera files and camera paths: keyframes as JSON, and the interpolated camera.
#pragma once

#include "core/camera.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::path {

/// A camera at a time, in seconds.
struct Keyframe {
    double time = 0;
    Camera camera;
};

/// Returns a keyframe with a camera at `eye` that looks at `target`, with y up and the default angle.
inline Keyframe keyframeAt(double time, const glm::dvec3& eye, const glm::dvec3& target) {
    return {time, {eye, target}};
}

enum class Interpolation { Linear, CatmullRom };

/// A camera path: keyframes sorted by time.
struct CameraPath {
    bool loop = false;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<Keyframe> keyframes; // at least one

    double duration() const { return keyframes.back().time - keyframes.front().time; }
};

/// Returns the camera of `path` at `time`. Times outside the path give the camera at its ends. The Catmull-Rom
/// interpolation is a cubic between keyframes at unevenly spaced times (Catmull and Rom 1974), not the centripetal
/// variant. The slope at a keyframe comes from both neighbours. At the ends of an open path it comes from one
/// neighbour. In a loop, whose last keyframe equals the first, the neighbours continue across the seam. The angle of
/// view stays between those of the two keyframes.
Camera cameraAt(const CameraPath& path, double time);

/// Returns the time of frame `frame` of `frames` evenly spaced frames. An open path includes both ends. A loop excludes
/// its end, because it equals the start.
double frameTime(const CameraPath& path, int frame, int frames);

/// Returns the number of equal time steps into which `frames` frames divide the duration of `path`.
int frameSteps(const CameraPath& path, int frames);

/// Returns `camera` rotated about its target. The axis is `up`, and the rotation is counter-clockwise as seen from
/// there.
Camera turnedAround(const Camera& camera, const glm::dvec3& up, double radians);

/// Reads one keyframe `{"eye", "target", "up", "fov_y", "projection"}`, or the first keyframe of a path. Only eye and
/// target are required. Throws Error with path and position.
Camera readCamera(const std::string& path);

/// Reads a path. All keyframes must have the same projection. Throws Error with path and position.
CameraPath readCameraPath(const std::string& path);

/// Returns `path` with `projection` in each keyframe, if one is given.
CameraPath projected(CameraPath path, const std::optional<Projection>& projection);

/// Cameras that a user saved for a model.
struct SavedViews {
    std::string model; // name of the model
    std::vector<Camera> cameras;
};

/// Reads a file of saved views in the format of toJson. Throws Error with path and position.
SavedViews readViews(const std::string& path);

std::string toJson(const SavedViews& views);

/// Returns the text of a camera file.
std::string toJson(const Camera& camera);

/// Returns the text of a path file.
std::string toJson(const CameraPath& path);

/// Returns the xxh3-64 hash of the content of `path`, in lowercase hex. The formatting of its file does not matter.
std::string contentHash(const CameraPath& path);

} // namespace gnomon::path
