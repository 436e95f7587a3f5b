// Saves the files of a window session under numbered names: images in the user's picture folder, camera files in the
// current folder, measurements next to the model. It never overwrites existing files.
#pragma once

#include "gl/api.h"
#include "path/camera_path.h"
#include "render/picture.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon::viewer {

/// Saves files whose names begin with the name of the model, for example "bunny_1.png" or "bunny_path1.json". All
/// functions throw Error if the file cannot be written. Functions with a result return the name of the file.
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

    /// Saves a camera file, which `gnomon render --camera` can read.
    std::string saveCamera(const Camera& camera) const;

    /// Saves the user's measurements as "bunny_measures1.json" and "bunny_measures1.csv" in the model's folder. If this
    /// folder is not writable, the current folder is used. Returns both names.
    std::string saveMeasures(const std::string& json, const std::string& csv) const;

    /// Saves the image of frame `frame` of a played camera path in `folder` as "frame0000.png". Creates the folder if
    /// needed.
    void savePlayed(const std::string& folder, int frame, const render::Picture& picture) const;

private:
    std::string saveNumbered(const std::string& kind, const render::Picture& picture) const;

    std::string stem_ = "gnomon";
    std::string folder_; // folder for measures
};

} // namespace gnomon::viewer
