// Conversion of settings to the view and the quality of a frame, with errors for settings that contradict each other.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"

#include <map>
#include <optional>
#include <span>
#include <string>

namespace gnomon::settings {

/// The texts of the given options, by the name of the setting.
using SettingTexts = std::map<std::string, std::string>;

/// Returns settings with the values of `given`, and the defaults of all other settings. Old names of settings are
/// accepted. If `withSwept` is false, the settings that a bench sweeps also have their defaults. Throws UsageError for
/// an invalid text, for an unknown name, and for options of shadow maps together with exact shadows.
Settings settingsOf(const SettingTexts& given, bool withSwept = true);

/// Throws UsageError if `texts` request exact shadows, because `option` applies to shadow maps only. The message names
/// `option`.
void requireMapsFor(const std::string& option, const SettingTexts& texts);

/// Returns true if an option sets a camera file, an eye, a target, a side of the model or an angle of view.
bool isPosed(const Settings& settings);

/// Returns true if no option sets the position of the eye. The camera then frames the model.
bool isFramed(const Settings& settings);

/// Reads the camera file of `settings`, if one is given. If `time` (seconds) is given, the file is a camera path, and
/// its camera at this time is used. Throws Error.
void readCamera(Settings& settings, std::optional<double> time = {});

/// The pictures in which the model must fit if no camera is given: one picture, all pictures of a turntable, or the
/// pictures of a camera path. The cameras of a path need no framing.
enum class Framing : std::uint8_t { OnePicture, EveryTurn, Path }; // the cameras of a path need no framing

/// Returns the view that `settings` request. Call requireSound and readCamera before. Without a camera the view frames
/// `outline` (path/outline.h), or the bounds of `summary` if `outline` is empty. Without a given up direction, uses
/// that of the model. Throws UsageError if eye and target are the same point.
plan::View viewOf(
    const Settings& settings,
    const hierarchy::ModelSummary& summary,
    std::span<const glm::dvec3> outline = {},
    Framing framing = Framing::OnePicture);

/// Returns `settings` with a known up direction. `auto` is replaced by an estimate from the shape of `model`, for which
/// the function reads coarse pages.
Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model);

/// Returns the view that `settings` request of `model`, after uprightIn. Reads coarse pages of the model if the view
/// has to frame its outline.
plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model, Framing framing = Framing::OnePicture);

/// Sets the section planes of `view` (world space), and whether they also cut casters.
void setSections(const Settings& settings, plan::View& view);

/// Throws UsageError if a point light is requested, because `option` supports directional lights only. The message
/// names `option`.
void requireDirectionalLight(const Settings& settings, const std::string& option);

/// Returns the quality that `settings` request. Call requireSound before.
plan::Quality qualityOf(const Settings& settings);

} // namespace gnomon::settings
