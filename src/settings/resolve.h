// From settings to the view and the quality that they ask for together, contradictions refused.
#pragma once

#include "hierarchy/model.h"
#include "settings/settings.h"

namespace gnomon::settings {

/// Whether the settings say where the camera is or what it is like.
bool isPosed(const Settings& settings);

/// The view that is asked for; a model of `summary` is framed where no camera is given. Reads the camera file, if there
/// is one. Throws UsageError for contradictions, Error for a file that is no camera.
plan::View viewOf(const Settings& settings, const hierarchy::ModelSummary& summary);

/// The quality that is asked for. Throws UsageError for contradictions.
plan::Quality qualityOf(const Settings& settings);

/// The camera that shows all of `bounds`, looked at slightly from above.
Camera framingCamera(const Box& bounds, double aspect, const glm::dvec3& up, double fovYRadians);

} // namespace gnomon::settings
