// Conversion of settings to the view and the quality of a frame, with errors for settings that contradict each other.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"

#include <map>
#include <span>
#include <string>

namespace gnomon::settings {

/// The texts of the given options, by the name of the setting.
using SettingTexts = std::map<std::string, std::string>;

/// Returns settings with the values of `texts`, and the default for all others. Without `withSwept`, settings that a
/// bench sweeps have their default too. Throws UsageError for an invalid text, for an unknown name, and for options of
/// shadow maps together with exact shadows.
Settings settingsOf(const SettingTexts& texts, bool withSwept = true);

/// Throws UsageError if `texts` request exact shadows, because `option` applies to shadow maps only. The message names
/// `option`.
void requireMapsFor(const std::string& option, const SettingTexts& texts);

/// Returns true if the settings give a camera file, an eye, a target, a side of the model or an angle of view.
bool isPosed(const Settings& settings);

/// Returns true if no option gives the position of the eye, so that the camera frames the whole model.
bool isFramed(const Settings& settings);

/// Returns the requested view. Reads the camera file, if one is given. Without a given camera, the view frames the
/// points of `outline` (path/outline.h), or the bounds in `summary` if `outline` is empty. The up direction `auto`
/// gives the up direction that the model stores. Throws UsageError for contradictions, and Error if the file is not a
/// camera.
plan::View viewOf(
    const Settings& settings, const hierarchy::ModelSummary& summary, std::span<const glm::dvec3> outline = {});

/// Returns `settings` with a known up direction. `auto` is replaced by an estimate from the shape of `model`, for which
/// the function reads coarse pages.
Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model);

/// Returns the requested view with the up direction of `uprightIn`. If the camera has to frame the model, the function
/// reads coarse pages for the outline.
plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model);

/// Sets the section planes of `view` (world space), and whether they also cut casters.
void setSections(const Settings& settings, plan::View& view);

/// Throws UsageError if a point light is requested, because `option` supports directional lights only. The message
/// names `option`.
void requireDirectionalLight(const Settings& settings, const std::string& option);

/// Returns the requested quality of frames. Throws UsageError for options that contradict each other.
plan::Quality qualityOf(const Settings& settings);

} // namespace gnomon::settings
