// Camera files and camera paths: keyframes as JSON, and the camera in between.
#pragma once

#include "core/camera.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::path {

/// A camera at a time, seconds.
struct Keyframe {
    double time = 0;
    Camera camera;
};

/// A keyframe that looks from `eye` at `target`, y up, with a camera's usual angle.
inline Keyframe keyframeAt(double time, const glm::dvec3& eye, const glm::dvec3& target) {
    return {time, {eye, target}};
}

enum class Interpolation { Linear, CatmullRom };

/// Keyframes in the order of their times.
struct CameraPath {
    bool loop = false;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<Keyframe> keyframes; // at least one

    double duration() const { return keyframes.back().time - keyframes.front().time; }
};

/// The camera of `path` at `time`, held at both ends. Catmull-Rom is the centripetal-free cubic over uneven times
/// (Catmull and Rom 1974). Its differences are one-sided at the ends of an open path, and reach across the seam of a
/// loop, whose last keyframe is its first again. The angle stays between those of its two keyframes.
Camera cameraAt(const CameraPath& path, double time);

/// The time of frame `frame` of `frames` that are spread evenly over `path`. An open path includes both ends; a loop
/// leaves out its end, which is its start.
double frameTime(const CameraPath& path, int frame, int frames);

/// The number of equal steps into which `frames` frames divide the duration of `path`.
int frameSteps(const CameraPath& path, int frames);

/// `camera` turned about its target, about the direction `up` and against the clock as seen from there.
Camera turnedAround(const Camera& camera, const glm::dvec3& up, double radians);

/// Reads one keyframe `{"eye", "target", "up", "fov_y", "projection"}`, of which all but eye and target may be missing,
/// or the first keyframe of a path. Throws Error with path and place.
Camera readCamera(const std::string& path);

/// Reads a path, all of whose keyframes have the same projection. Throws Error with path and place.
CameraPath readCameraPath(const std::string& path);

/// `path` with every keyframe of that projection, where one is given.
CameraPath projected(CameraPath path, const std::optional<Projection>& projection);

/// Cameras at which someone looked at a model.
struct SavedViews {
    std::string model; // what it is called
    std::vector<Camera> cameras;
};

/// Reads what toJson writes of them. Throws Error with path and place.
SavedViews readViews(const std::string& path);

std::string toJson(const SavedViews& views);

/// The text of a camera file.
std::string toJson(const Camera& camera);

/// The text of a path file.
std::string toJson(const CameraPath& path);

/// xxh3-64 of what `path` says, in lower hex; how its file writes it makes no difference.
std::string contentHash(const CameraPath& path);

} // namespace gnomon::path
