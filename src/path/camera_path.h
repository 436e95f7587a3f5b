// Camera files and camera paths. A path is a list of keyframes in JSON, between which the camera is interpolated.
#pragma once

#include "core/camera.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::path {

/// A camera and its time in seconds on a camera path.
struct Keyframe {
    double time = 0;
    Camera camera;
};

/// Returns a keyframe whose camera is at `eye` and looks at `target`, with y up and the default angle of view.
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

/// Returns the interpolated camera of `path` at `time`. Before the first and after the last keyframe, it returns the
/// camera of that keyframe. The interpolation is a cubic Catmull-Rom spline over unevenly spaced times (Catmull and Rom
/// 1974), not the centripetal variant. The slope at a keyframe comes from both neighbours, and at the ends of an open
/// path from one neighbour. A path whose last keyframe equals the first is a loop, in which the neighbours continue
/// across the seam. The angle of view stays between those of the two keyframes.
Camera cameraAt(const CameraPath& path, double time);

/// Returns the time of frame `frame` if `frames` frames are evenly spaced over `path`. The last frame is at the end of
/// an open path. In a loop no frame is at the end, because the end equals the start.
double frameTime(const CameraPath& path, int frame, int frames);

/// Returns into how many equal time steps `frames` evenly spaced frames divide the duration of `path`.
int frameSteps(const CameraPath& path, int frames);

/// Returns `camera` rotated about the axis `up` through its target. The rotation is counter-clockwise, seen from the
/// tip of `up`.
Camera turnedAround(const Camera& camera, const glm::dvec3& up, double radians);

/// Reads a camera file `{"eye", "target", "up", "fov_y", "projection"}`, or the first keyframe of a camera path. Only
/// eye and target are required. Throws Error with path and position.
Camera readCamera(const std::string& path);

/// Reads a camera path from a file. All keyframes must have the same projection. Throws Error with path and position.
CameraPath readCameraPath(const std::string& path);

/// Returns `path` with all keyframes changed to `projection`. Returns `path` itself if no projection is given.
CameraPath projected(CameraPath path, const std::optional<Projection>& projection);

/// The cameras that a user has saved for a model.
struct SavedViews {
    std::string model; // name of the model
    std::vector<Camera> cameras;
};

/// Reads the cameras that a user has saved, in the format of toJson. Throws Error with path and position.
SavedViews readViews(const std::string& path);

std::string toJson(const SavedViews& views);

/// Returns `camera` as the JSON text of a camera file.
std::string toJson(const Camera& camera);

/// Returns `path` as the JSON text of a path file.
std::string toJson(const CameraPath& path);

/// Returns the xxh3-64 hash of the content of `path`, in lowercase hex. The formatting of the file does not change it.
std::string contentHash(const CameraPath& path);

} // namespace gnomon::path
