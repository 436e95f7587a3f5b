// The files that a session saves under numbered names: pictures in the user's folder of pictures, paths and cameras in
// the current folder, measures beside the model. No file that exists is overwritten.
#pragma once

#include "executor/picture.h"
#include "gl/api.h"
#include "path/camera_path.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon::viewer {

/// Names begin with that of the model: "bunny_1.png", "bunny_path1.json". Everything returns the file's name and throws
/// Error if it cannot be written.
class SavedFiles {
public:
    SavedFiles() = default;
    explicit SavedFiles(const std::string& modelPath);

    /// "Gnomon/bunny_1.png" in the folder of pictures that the XDG user directories name, else in ~/Pictures, in the
    /// home folder, or in the current one.
    std::string savePicture(const executor::Picture& picture) const;

    /// Saves the window's own framebuffer beside it, as "bunny_window1.png". The framebuffer must be complete and
    /// bound.
    std::string saveWindow(const gl::Api& gl, const glm::ivec2& size) const;

    std::string savePath(const path::CameraPath& path) const;

    /// A file that `gnomon render --camera` reads.
    std::string saveCamera(const Camera& camera) const;

    /// "bunny_measures1.json" and "bunny_measures1.csv", in the model's folder or, where nothing can be written there,
    /// in the current one; both names.
    std::string saveMeasures(const std::string& json, const std::string& csv) const;

    /// Frame `frame` of a played path into `folder`, which is made if need be: "frame0000.png".
    void savePlayed(const std::string& folder, int frame, const executor::Picture& picture) const;

private:
    std::string saveNumbered(const std::string& kind, const executor::Picture& picture) const;

    std::string stem_ = "gnomon";
    std::string folder_; // of what it measures
};

} // namespace gnomon::viewer
