// One picture of a model, and what is asked beside it: the frame's row of the log, depths, maps, a comparison.
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

/// Which picture, and what of it goes where; an empty path is nothing.
struct StillTask {
    std::string model;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    executor::Overlay overlay = executor::Overlay::None;
    settings::ValueColors colors; // in place of the model's own, at one sample
    std::optional<int> samples;   // frames that it is the mean of; nothing: the usual number, 1 beside what is of one
    std::optional<Camera> camera; // in place of the settings'
    proof::Oracle oracle = proof::Oracle::None;
    std::string output;     // PNG
    std::string statistics; // JSON
    std::string reference;  // PNG, read
    double referenceThreshold = 0.01;
    std::string depth;       // PFM
    std::string shadowDepth; // folder
};

/// Draws it. Files appear when they are complete. Throws Error, and UsageError for what contradicts itself.
void drawStill(const StillTask& task, Progress& progress);

} // namespace gnomon::measure
