// One picture of a model, with optional outputs: statistics, depths, shadow maps and a comparison with a reference.
#pragma once

#include "core/progress.h"
#include "executor/executor.h"
#include "proof/frame_proof.h"
#include "settings/settings.h"
#include "settings/value_colors.h"

#include <functional>
#include <optional>
#include <string>

namespace gnomon::measure {

/// The picture to draw and its output files. An empty path means that the output is not requested.
struct StillTask {
    std::string model;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    executor::Overlay overlay = executor::Overlay::None;
    settings::ValueColors colors; // replaces the colours of the model; requires one sample
    std::optional<int> samples;   // number of frames that are averaged; nullopt: the default of settings::samplesOf
    std::optional<Camera> camera; // replaces the camera of the settings
    proof::Oracle oracle = proof::Oracle::None;
    std::string output;     // picture, PNG
    std::string statistics; // row of the frame in the log, JSON
    std::string reference;  // input: a PNG to compare the picture with
    double referenceThreshold = 0.01;
    std::string depth;       // view depths, PFM
    std::string shadowDepth; // folder for the shadow maps
};

/// Draws the picture and writes the requested files. Each file appears when it is complete. Throws Error, also if the
/// picture differs from the reference, and UsageError for options that contradict each other.
void drawStill(const StillTask& task, Progress& progress);

} // namespace gnomon::measure
