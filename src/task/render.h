// Pictures of a model: one with what is asked beside it, or many along a path or all around the model.
#pragma once

#include "core/progress.h"
#include "path/camera_path.h"
#include "render/picture.h"
#include "settings/contradictions.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::task {

/// The decided values of a render.
struct RenderTask {
    std::string model;
    settings::Settings settings; // of the view, and of the memory
    plan::Quality quality;
    settings::Output output;
    int samples = 1;  // frames per picture
    int pictures = 1; // of a series
    settings::Backend backend = settings::Backend::Software;
    std::optional<path::CameraPath> path;     // of `--path`
    std::optional<render::Picture> reference; // of `--reference`
    std::function<void(const std::string&)> warn;
    std::function<void(const std::string& bytes)> stream; // takes the bytes of a series to "-"
};

/// Returns the task of `request`: refuses contradictions, reads the cameras, and decides quality, samples and backend.
/// Throws UsageError and Error.
RenderTask renderTask(settings::Request request);

/// Draws the pictures of `task`. Each file appears when it is complete. Throws Error.
void render(const RenderTask& task, Progress& progress);

} // namespace gnomon::task
