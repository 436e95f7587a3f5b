#include "viewer/saved_files.h"

#include "core/file.h"
#include "core/temporary_name.h"
#include "hierarchy/source/open_source.h"
#include "viewer/environment_path.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace gnomon::viewer {

namespace {

namespace fs = std::filesystem;

/// Creates new files with the names START NUMBER SUFFIX, one per suffix, and calls `write` with the names. Returns the
/// names. NUMBER is the first for which no file exists. The files are created at once, so that a second window cannot
/// choose the same names.
std::vector<std::string> saveNew(
    const std::string& start,
    const std::vector<std::string>& suffixes,
    const std::function<void(const std::vector<std::string>&)>& write) {
    constexpr unsigned kPermissions = 0666;
    for (int number = 1;; ++number) {
        std::vector<std::string> names;
        std::vector<std::unique_ptr<TemporaryName>> made;
        for (const std::string& suffix : suffixes) {
            const std::string& name = names.emplace_back(start).append(std::to_string(number)).append(suffix);
            made.push_back(std::make_unique<TemporaryName>(
                name, [&] { return File::createdNew(name, kPermissions, name).has_value(); }));
            if (!made.back()->isHeld()) break;
        }
        if (!made.back()->isHeld()) continue;
        write(names);
        for (const auto& name : made)
            name->keep([] { return true; });
        return names;
    }
}

/// Returns the picture folder that the user has chosen, like `xdg-user-dir PICTURES`. It comes from the environment, or
/// from a line XDG_PICTURES_DIR="$HOME/PATH" or "/PATH" of the file user-dirs.dirs.
std::string chosenPicturesFolder(const std::string& home) {
    std::string chosen = environmentPath("XDG_PICTURES_DIR");
    if (!chosen.empty()) return chosen;
    const std::string config = environmentPath("XDG_CONFIG_HOME");
    std::ifstream lines((config.empty() ? home + "/.config" : config) + "/user-dirs.dirs");
    constexpr std::string_view kStart = "XDG_PICTURES_DIR=\"";
    std::string found;
    for (std::string line; std::getline(lines, line);) {
        line.erase(0, line.find_first_not_of(" \t"));
        const std::size_t end = line.rfind('"');
        if (!line.starts_with(kStart) || end < kStart.size()) continue;
        const std::string value = line.substr(kStart.size(), end - kStart.size());
        if (value.starts_with("$HOME/"))
            found = home + value.substr(5);
        else if (value.starts_with('/'))
            found = value;
    }
    return found;
}

/// Returns the folder "Gnomon" in the user's picture folder, else in the home folder, else in the current folder.
/// Creates it if it is missing.
std::string pictureFolder() {
    const std::string home = environmentPath("HOME");
    std::vector<std::string> folders = {chosenPicturesFolder(home)};
    if (!home.empty()) folders.insert(folders.end(), {home + "/Pictures", home});
    for (const std::string& folder : folders) {
        if (folder.empty()) continue;
        std::string ours = folder + "/Gnomon";
        std::error_code failure;
        fs::create_directories(ours, failure);
        if (::access(ours.c_str(), W_OK | X_OK) == 0) return ours;
    }
    fs::create_directories("Gnomon");
    return "Gnomon";
}

} // namespace

SavedFiles::SavedFiles(const std::string& modelPath) {
    const std::string stem = fs::path(modelPath).stem().string();
    if (!stem.empty()) stem_ = stem;
    const std::string folder = fs::path(modelPath).parent_path().string();
    // The current folder is used for measurements if the model is on a server or in a folder without write permission.
    if (!hierarchy::isAddress(modelPath) && ::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0)
        folder_ = folder;
}

std::string SavedFiles::savePicture(const render::Picture& picture) const {
    return saveNumbered("_", picture);
}

std::string SavedFiles::saveNumbered(const std::string& kind, const render::Picture& picture) const {
    const auto write = [&](const std::vector<std::string>& names) { render::writePng(names.front(), picture); };
    return saveNew(pictureFolder() + "/" + stem_ + kind, {".png"}, write).front();
}

std::string SavedFiles::saveWindow(const gl::Api& gl, const glm::ivec2& size) const {
    render::Picture picture(size.x, size.y);
    gl.readPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
    for (int top = 0, bottom = size.y - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(&picture.at(0, top), &picture.at(0, top) + size.x, &picture.at(0, bottom));
    return saveNumbered("_window", picture);
}

std::string SavedFiles::savePath(const path::CameraPath& path) const {
    const auto write = [&](const std::vector<std::string>& names) { writeTextFile(names.front(), path::toJson(path)); };
    return saveNew(stem_ + "_path", {".json"}, write).front();
}

std::string SavedFiles::saveCamera(const Camera& camera) const {
    const auto write = [&](const std::vector<std::string>& names) {
        writeTextFile(names.front(), path::toJson(camera));
    };
    return saveNew(stem_ + "_camera", {".json"}, write).front();
}

std::string SavedFiles::saveMeasures(const std::string& json, const std::string& csv) const {
    const auto write = [&](const std::vector<std::string>& names) {
        writeTextFile(names.front(), json);
        writeTextFile(names.back(), csv);
    };
    const std::string start = (fs::path(folder_) / (stem_ + "_measures")).string();
    const std::vector<std::string> names = saveNew(start, {".json", ".csv"}, write);
    return names.front() + " and " + names.back();
}

void SavedFiles::savePlayed(const std::string& folder, int frame, const render::Picture& picture) const {
    fs::create_directories(folder);
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame%04d.png", frame);
    render::writePng((fs::path(folder) / name.data()).string(), picture);
}

} // namespace gnomon::viewer
