// Saves the files of a session under numbered names: images in the user's picture folder, paths and cameras in the
// current folder, measures next to the model. It never overwrites existing files.
#pragma once

#include "gl/api.h"
#include "path/camera_path.h"
#include "render/picture.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon::viewer {

/// Saves files whose names begin with the name of the model, for example "bunny_1.png" or "bunny_path1.json". All
/// functions return the name of the file and throw Error if it cannot be written.
class SavedFiles {
public:
    SavedFiles() = default;
    explicit SavedFiles(const std::string& modelPath);

    /// Saves an image as "Gnomon/bunny_1.png" in the picture folder of the XDG user directories, else in ~/Pictures, in
    /// the home folder, or in the current folder.
    std::string savePicture(const render::Picture& picture) const;

    /// Saves the framebuffer of the window as "bunny_window1.png" in the same folder as savePicture. The framebuffer
    /// must be complete and bound.
    std::string saveWindow(const gl::Api& gl, const glm::ivec2& size) const;

    std::string savePath(const path::CameraPath& path) const;

    /// Saves a file for `gnomon render --camera`.
    std::string saveCamera(const Camera& camera) const;

    /// Saves "bunny_measures1.json" and "bunny_measures1.csv" in the model's folder, or in the current folder if that
    /// is not writable. Returns both names.
    std::string saveMeasures(const std::string& json, const std::string& csv) const;

    /// Saves frame `frame` of a played path in `folder` as "frame0000.png". Creates the folder if needed.
    void savePlayed(const std::string& folder, int frame, const render::Picture& picture) const;

private:
    std::string saveNumbered(const std::string& kind, const render::Picture& picture) const;

    std::string stem_ = "gnomon";
    std::string folder_; // folder for measures
};

} // namespace gnomon::viewer
