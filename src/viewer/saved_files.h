// What a session saves: pictures and camera paths, numbered, in the current folder, over no file that is there; what it
// measures of a model, beside that.
#pragma once

#include "executor/picture.h"
#include "gl/api.h"
#include "path/camera_path.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon::viewer {

/// Names are those of the model: "bunny_view1.png", "bunny_path1.json". Everything returns the file's name and throws
/// Error if it cannot be written.
class SavedFiles {
public:
    SavedFiles() = default;
    explicit SavedFiles(const std::string& modelPath);

    std::string savePicture(const executor::Picture& picture) const;

    /// The window's own framebuffer, which must be complete and bound.
    std::string saveWindow(const gl::Api& gl, const glm::ivec2& size) const;

    std::string savePath(const path::CameraPath& path) const;

    /// A file that `gnomon render --camera` reads.
    std::string saveCamera(const Camera& camera) const;

    /// "bunny_measures1.json" and "bunny_measures1.csv", in the model's folder; both names.
    std::string saveMeasures(const std::string& json, const std::string& csv) const;

    /// Frame `frame` of a played path into `folder`, which is made if need be: "frame0000.png".
    void savePlayed(const std::string& folder, int frame, const executor::Picture& picture) const;

private:
    std::string freeName(const std::string& kind, const std::string& suffix) const;

    std::string stem_ = "gnomon";
    std::string folder_; // the model's
};

} // namespace gnomon::viewer
