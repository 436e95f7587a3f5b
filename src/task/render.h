// Draws pictures of a model: one picture with its additional files, or a series along a camera path or around the
// model.
#pragma once

#include "core/progress.h"
#include "path/camera_path.h"
#include "render/picture.h"
#include "settings/contradictions.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::task {

/// The input of `gnomon render` after all defaults and automatic choices.
struct RenderTask {
    std::string model;
    settings::Settings settings; // settings of the view and of the memory
    plan::Quality quality;
    settings::Output output;
    int samples = 1;  // number of frames per picture
    int pictures = 1; // number of pictures of the series
    settings::Backend backend = settings::Backend::Software;
    std::optional<path::CameraPath> path;     // path of `--path`
    std::optional<render::Picture> reference; // picture of `--reference`
    std::function<void(const std::string&)> warn;
    std::function<void(const std::string& bytes)> stream; // receives the bytes of a series with the output "-"
};

/// Converts the options of `request` to a task for `render`. Rejects contradictions, reads the cameras, and chooses
/// quality, samples and backend. Throws UsageError and Error.
RenderTask renderTask(settings::Request request);

/// Draws and writes the pictures of `task`. Each file appears when it is complete. Throws Error.
void render(const RenderTask& task, Progress& progress);

} // namespace gnomon::task
