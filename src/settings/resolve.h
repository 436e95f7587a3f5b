// Converts settings to the view and the quality of a frame. Throws errors for settings that contradict each other.
#pragma once

#include "hierarchy/model_file.h"
#include "settings/settings.h"

#include <map>
#include <optional>
#include <span>
#include <string>

namespace gnomon::settings {

/// The option values as the user typed them, by the name of the setting.
using SettingTexts = std::map<std::string, std::string>;

/// Parses `given` and returns the settings. A setting that is not in `given` has its default. Old names of settings are
/// accepted. If `withSwept` is false, the settings that `gnomon bench` sweeps also have their defaults. Throws
/// UsageError for an invalid text, for an unknown name, and for options of shadow maps together with exact shadows.
Settings settingsOf(const SettingTexts& given, bool withSwept = true);

/// Throws UsageError if `texts` request exact shadows, because `option` has an effect on shadow maps only. The message
/// names `option`.
void requireMapsFor(const std::string& option, const SettingTexts& texts);

/// Returns true if an option sets any part of the camera: a camera file, an eye, a target, a side of the model or an
/// angle of view.
bool isPosed(const Settings& settings);

/// Returns true if no option sets the position of the eye. The camera is then placed so that the model fits in the
/// image.
bool isFramed(const Settings& settings);

/// Reads the camera file that `settings` name, if any, and stores its camera in `settings`. If `time` (seconds) is
/// given, the file is a camera path, and its camera at this time is used. Throws Error.
void readCamera(Settings& settings, std::optional<double> time = {});

/// The pictures in which the whole model must be visible if no camera is given: one picture, or all pictures of a
/// turntable. A camera path needs no such framing.
enum class Framing : std::uint8_t { OnePicture, EveryTurn, Path }; // the cameras of a path need no framing

/// Returns the view that `settings` request. requireSound and readCamera must be called before. Without a camera, the
/// view shows all points of `outline` (path/outline.h), or the bounds of `summary` if `outline` is empty. Without an up
/// direction, the view uses the one of the model. Throws UsageError if eye and target are the same point.
plan::View viewOf(
    const Settings& settings,
    const hierarchy::ModelSummary& summary,
    std::span<const glm::dvec3> outline = {},
    Framing framing = Framing::OnePicture);

/// Returns `settings` with a known up direction. If it is `auto`, the function estimates it from the shape of `model`,
/// for which it reads coarse pages.
Settings uprightIn(const Settings& settings, const hierarchy::ModelFile& model);

/// Returns the view that `settings` request for `model`, with a known up direction (see uprightIn). Reads coarse pages
/// of the model if the camera must be placed so that the whole model is visible.
plan::View viewOf(const Settings& settings, const hierarchy::ModelFile& model, Framing framing = Framing::OnePicture);

/// Copies the section planes (world space) to `view`, and whether sections also remove shadow casters.
void setSections(const Settings& settings, plan::View& view);

/// Throws UsageError if `settings` request a point light, because `option` supports only directional lights. The
/// message names `option`.
void requireDirectionalLight(const Settings& settings, const std::string& option);

/// Returns the quality of the frame that `settings` request. requireSound must be called before.
plan::Quality qualityOf(const Settings& settings);

} // namespace gnomon::settings
