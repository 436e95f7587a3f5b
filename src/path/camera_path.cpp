#include "path/camera_path.h"

#include "core/angle.h"
#include "core/error.h"
#include "core/json_file.h"
#include "hierarchy/file_layout.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace gnomon::path {

namespace {

using nlohmann::ordered_json;

/// Converts radians to degrees, rounded to 1e-9 degrees if this value reads back exactly. An angle of 60 degrees in a
/// file thus stays 60.
double degreesOf(double radians) {
    const double degrees = radians / radiansFromDegrees(1);
    const double shorter = std::round(degrees * 1e9) / 1e9;
    return radiansFromDegrees(shorter) == radians ? shorter : degrees;
}

glm::dvec3 vectorOf(const ordered_json& object, const char* key, const std::string& where) {
    const auto found = object.find(key);
    const bool isVector = found != object.end() && found->is_array() && found->size() == 3 &&
                          std::all_of(found->begin(), found->end(), [](const auto& v) { return v.is_number(); });
    if (!isVector) throw Error(where, std::string("\"") + key + "\" is missing or not a vector", "[x, y, z]", "none");
    return {(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
}

double numberOf(const ordered_json& object, const char* key, const std::string& where) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number())
        throw Error(where, std::string("\"") + key + "\" is missing or not a number");
    return found->get<double>();
}

Camera cameraOf(const ordered_json& object, const std::string& where) {
    if (!object.is_object())
        throw Error(where, "the camera is not a JSON object", "{\"eye\": ...}", object.type_name());
    Camera camera;
    camera.eye = vectorOf(object, "eye", where);
    camera.target = vectorOf(object, "target", where);
    if (object.contains("up")) camera.up = vectorOf(object, "up", where);
    if (object.contains("fov_y")) camera.fovYRadians = radiansFromDegrees(numberOf(object, "fov_y", where));
    if (!(camera.fovYRadians > 0 && camera.fovYRadians < kPi))
        throw Error(
            where, "\"fov_y\" is out of range", "above 0 and below 180 degrees", telemetry::jsonText(object["fov_y"]));
    if (object.contains("projection")) {
        const ordered_json& word = object["projection"];
        const auto projection = valueOf(kProjections, word.is_string() ? word.get<std::string>() : "");
        if (!projection)
            throw Error(
                where, "unknown \"projection\"", enumerated(kProjections, ", ", " or "), telemetry::jsonText(word));
        camera.projection = *projection;
    }
    cameraBasis(camera); // throws if eye and target are the same point
    return camera;
}

ordered_json jsonOf(const Camera& camera) {
    const auto list = [](const glm::dvec3& v) { return ordered_json{v.x, v.y, v.z}; };
    ordered_json object;
    object["eye"] = list(camera.eye);
    object["target"] = list(camera.target);
    object["up"] = list(camera.up);
    object["fov_y"] = degreesOf(camera.fovYRadians);
    if (camera.isParallel()) object["projection"] = wordOf(kProjections, camera.projection);
    return object;
}

/// The cubic that interpolates a camera value between the keyframes b and c. Its slopes come from the values and times
/// of a, b, c and d (Catmull and Rom 1974).
struct Segment {
    double t0 = 0;
    double t1 = 0;
    double t2 = 0;
    double t3 = 0;
    double u = 0; // 0 at t1, 1 at t2

    template <class T>
    T operator()(const T& a, const T& b, const T& c, const T& d) const {
        const double span = t2 - t1;
        const T slopeB = t2 > t0 ? (c - a) * (span / (t2 - t0)) : (c - b);
        const T slopeC = t3 > t1 ? (d - b) * (span / (t3 - t1)) : (c - b);
        const double u2 = u * u;
        const double u3 = u2 * u;
        return b * (2 * u3 - 3 * u2 + 1) + slopeB * (u3 - 2 * u2 + u) + c * (3 * u2 - 2 * u3) + slopeC * (u3 - u2);
    }
};

Keyframe shifted(Keyframe key, double seconds) {
    key.time += seconds;
    return key;
}

/// Reads the JSON of a camera file or a camera path. Throws Error for a glTF file, whose cameras have another format.
ordered_json cameraDocument(const std::string& path) {
    for (const char* const suffix : {".gltf", ".glb"})
        if (path.ends_with(suffix))
            throw Error(
                path,
                "this file is not a camera file",
                "a file that the command path writes from it (kind source)",
                "a glTF");
    return readJsonFile(path);
}

CameraPath pathOf(const ordered_json& document, const std::string& path) {
    CameraPath result;
    if (!document.is_object() || !document.contains("keyframes") || !document["keyframes"].is_array() ||
        document["keyframes"].empty())
        throw Error(path, "the camera path has no keyframes", "{\"keyframes\": [...]}", "none");
    const ordered_json loop = document.value("loop", ordered_json(false));
    if (!loop.is_boolean()) throw Error(path, R"("loop")", "true or false", telemetry::jsonText(loop));
    result.loop = loop.get<bool>();
    const ordered_json interpolation = document.value("interpolation", ordered_json("linear"));
    if (interpolation != "linear" && interpolation != "catmull-rom")
        throw Error(path, "unknown \"interpolation\"", "linear or catmull-rom", telemetry::jsonText(interpolation));
    result.interpolation = interpolation == "linear" ? Interpolation::Linear : Interpolation::CatmullRom;
    for (const ordered_json& key : document["keyframes"]) {
        const std::string where = path + ": keyframe " + std::to_string(result.keyframes.size());
        const Camera camera = cameraOf(key, where);
        const double time = numberOf(key, "time", where);
        if (!result.keyframes.empty() && time < result.keyframes.back().time)
            throw Error(where, "keyframes must be in the order of their times");
        if (!result.keyframes.empty() && camera.projection != result.keyframes.front().camera.projection)
            throw Error(where, "all keyframes of a path must have the same \"projection\"");
        result.keyframes.push_back({time, camera});
    }
    return result;
}

} // namespace

Camera cameraAt(const CameraPath& path, double time) {
    const std::vector<Keyframe>& keys = path.keyframes;
    if (path.loop && path.duration() > 0)
        time = keys.front().time +
               std::fmod(std::fmod(time - keys.front().time, path.duration()) + path.duration(), path.duration());
    if (time <= keys.front().time) return keys.front().camera;
    if (time >= keys.back().time) return keys.back().camera;
    const auto next =
        std::upper_bound(keys.begin(), keys.end(), time, [](double t, const Keyframe& key) { return t < key.time; });
    const auto at = static_cast<std::size_t>(next - keys.begin());
    const Keyframe& b = keys[at - 1];
    const Keyframe& c = keys[at];
    // The last keyframe of a loop equals the first. The times of neighbours across the seam are therefore shifted by
    // one duration of the path.
    const double period = path.loop ? path.duration() : 0;
    const bool wraps = path.loop && keys.size() > 2;
    const Keyframe a = at >= 2 ? keys[at - 2] : wraps ? shifted(keys[keys.size() - 2], -period) : b;
    const Keyframe d = at + 1 < keys.size() ? keys[at + 1] : wraps ? shifted(keys[1], period) : c;
    const double u = c.time > b.time ? (time - b.time) / (c.time - b.time) : 0;
    const auto blend = [&](const auto& member) {
        if (path.interpolation == Interpolation::Linear) return b.camera.*member * (1 - u) + c.camera.*member * u;
        return Segment{a.time, b.time, c.time, d.time, u}(
            a.camera.*member, b.camera.*member, c.camera.*member, d.camera.*member);
    };
    Camera camera;
    camera.eye = blend(&Camera::eye);
    camera.target = blend(&Camera::target);
    camera.up = blend(&Camera::up);
    camera.projection = b.camera.projection;
    camera.fovYRadians = blend(&Camera::fovYRadians);
    if (path.interpolation == Interpolation::CatmullRom) { // the cubic can overshoot the valid range of angles
        const auto [minFovY, maxFovY] = std::minmax(b.camera.fovYRadians, c.camera.fovYRadians);
        camera.fovYRadians = std::clamp(camera.fovYRadians, minFovY, maxFovY);
    }
    return camera;
}

double frameTime(const CameraPath& path, int frame, int frames) {
    return path.keyframes.front().time + path.duration() * frame / std::max(frameSteps(path, frames), 1);
}

int frameSteps(const CameraPath& path, int frames) {
    return path.loop ? frames : frames - 1;
}

Camera turnedAround(const Camera& camera, const glm::dvec3& up, double radians) {
    const glm::dvec3 axis = glm::normalize(up);
    const auto turned = [&](const glm::dvec3& arm) {
        const glm::dvec3 along = axis * glm::dot(axis, arm);
        return along + std::cos(radians) * (arm - along) + std::sin(radians) * glm::cross(axis, arm);
    };
    Camera result = camera;
    result.eye = camera.target + turned(camera.eye - camera.target);
    if (camera.up != up) result.up = turned(camera.up);
    return result;
}

Camera readCamera(const std::string& path) {
    const ordered_json document = cameraDocument(path);
    if (document.is_object() && document.contains("keyframes")) return pathOf(document, path).keyframes.front().camera;
    return cameraOf(document, path);
}

CameraPath readCameraPath(const std::string& path) {
    return pathOf(cameraDocument(path), path);
}

std::string toJson(const CameraPath& path) {
    ordered_json document;
    document["loop"] = path.loop;
    document["interpolation"] = path.interpolation == Interpolation::Linear ? "linear" : "catmull-rom";
    document["keyframes"] = ordered_json::array();
    for (const Keyframe& key : path.keyframes) {
        ordered_json entry;
        entry["time"] = key.time;
        entry.update(jsonOf(key.camera));
        document["keyframes"].push_back(entry);
    }
    return telemetry::jsonText(document, 1) + "\n";
}

CameraPath projected(CameraPath path, const std::optional<Projection>& projection) {
    for (Keyframe& key : path.keyframes)
        key.camera.projection = projection.value_or(key.camera.projection);
    return path;
}

SavedViews readViews(const std::string& path) {
    const ordered_json document = readJsonFile(path);
    const bool isOne = document.is_object() && document.value("model", ordered_json()).is_string() &&
                       document.value("views", ordered_json()).is_array();
    if (!isOne)
        throw Error(
            path, "this file does not contain recent views", R"({"model": ..., "views": [...]})", "something else");
    SavedViews result{document["model"].get<std::string>(), {}};
    for (const ordered_json& view : document["views"])
        result.cameras.push_back(cameraOf(view, path + ": view " + std::to_string(result.cameras.size())));
    return result;
}

std::string toJson(const SavedViews& views) {
    ordered_json document;
    document["model"] = views.model;
    document["views"] = ordered_json::array();
    for (const Camera& camera : views.cameras)
        document["views"].push_back(jsonOf(camera));
    return telemetry::jsonText(document, 1) + "\n";
}

std::string toJson(const Camera& camera) {
    return telemetry::jsonText(jsonOf(camera), 1) + "\n";
}

std::string contentHash(const CameraPath& path) {
    const std::string text = toJson(path);
    std::array<char, 17> hex{};
    std::snprintf(
        hex.data(),
        hex.size(),
        "%016llx",
        static_cast<unsigned long long>(hierarchy::checksum64(std::as_bytes(std::span(text)))));
    return hex.data();
}

} // namespace gnomon::path
