#include "viewer/saved_files.h"

#include "core/file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

namespace gnomon::viewer {

SavedFiles::SavedFiles(const std::string& modelPath)
    : stem_(std::filesystem::path(modelPath).stem().string()),
      folder_(std::filesystem::path(modelPath).parent_path().string()) {}

std::string SavedFiles::freeName(const std::string& kind, const std::string& suffix) const {
    for (int number = 1;; ++number) {
        std::string name = stem_ + "_" + kind;
        name += std::to_string(number) + suffix;
        if (!std::filesystem::exists(name)) return name;
    }
}

std::string SavedFiles::savePicture(const executor::Picture& picture) const {
    std::string name = freeName("view", ".png");
    executor::writePng(name, picture);
    return name;
}

std::string SavedFiles::saveWindow(const gl::Api& gl, const glm::ivec2& size) const {
    executor::Picture picture(size.x, size.y);
    gl.readPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
    for (int top = 0, bottom = size.y - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(&picture.at(0, top), &picture.at(0, top) + size.x, &picture.at(0, bottom));
    std::string name = freeName("window", ".png");
    executor::writePng(name, picture);
    return name;
}

std::string SavedFiles::savePath(const path::CameraPath& path) const {
    std::string name = freeName("path", ".json");
    writeTextFile(name, path::toJson(path));
    return name;
}

std::string SavedFiles::saveCamera(const Camera& camera) const {
    std::string name = freeName("camera", ".json");
    writeTextFile(name, path::toJson(camera));
    return name;
}

std::string SavedFiles::saveMeasures(const std::string& json, const std::string& csv) const {
    const std::string place = (std::filesystem::path(folder_) / (stem_ + "_measures")).string();
    for (int number = 1;; ++number) {
        std::string jsonName = place;
        jsonName += std::to_string(number);
        std::string csvName = jsonName;
        jsonName += ".json";
        csvName += ".csv";
        if (std::filesystem::exists(jsonName) || std::filesystem::exists(csvName)) continue;
        writeTextFile(jsonName, json);
        writeTextFile(csvName, csv);
        return jsonName.append(" and ").append(csvName);
    }
}

void SavedFiles::savePlayed(const std::string& folder, int frame, const executor::Picture& picture) const {
    std::filesystem::create_directories(folder);
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame%04d.png", frame);
    executor::writePng((std::filesystem::path(folder) / name.data()).string(), picture);
}

} // namespace gnomon::viewer
