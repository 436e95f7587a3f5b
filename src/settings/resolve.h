// From settings to the view and the quality that they ask for together, contradictions refused.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"

#include <map>
#include <span>
#include <string>

namespace gnomon::settings {

/// What is written behind options, by the names of their settings.
using SettingTexts = std::map<std::string, std::string>;

/// Those settings, the others as they are by default; likewise those that a bench sweeps, but `withSwept`. Throws
/// UsageError for texts that are no value, for names that are none of a setting, and for maps asked for beside exact
/// shadows.
Settings settingsOf(const SettingTexts& texts, bool withSwept = true);

/// Throws UsageError if `texts` ask for exact shadows beside `option`, which is about shadow maps.
void requireMapsFor(const std::string& option, const SettingTexts& texts);

/// Whether the settings say where the camera is or what it is like.
bool isPosed(const Settings& settings);

/// Whether the eye is where it sees the whole model, for nothing says where else.
bool isFramed(const Settings& settings);

/// The view that is asked for; where no camera is given, `outline` (path/outline.h) is framed, or the bounds of
/// `summary` where it is empty. An up that is auto is the model's own. Reads the camera file, if there is one. Throws
/// UsageError for contradictions, Error for a file that is no camera.
plan::View viewOf(
    const Settings& settings, const hierarchy::ModelSummary& summary, std::span<const glm::dvec3> outline = {});

/// `settings` with the up that they ask for: by the shape of `model` where it is auto, for which coarse pages are read.
Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model);

/// The same with that up and the outline of `model`, whose coarse pages it reads where it has to frame it.
plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model);

/// Gives `view` the sections that are asked for.
void setSections(const Settings& settings, plan::View& view);

/// Throws UsageError where a point light is asked for beside `option`, which knows none.
void requireDirectionalLight(const Settings& settings, const std::string& option);

/// The quality that is asked for. Throws UsageError for contradictions.
plan::Quality qualityOf(const Settings& settings);

} // namespace gnomon::settings
