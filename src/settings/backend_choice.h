// The choice of the backend that draws, and the options that only the software backend can draw.
#pragma once

#include "settings/settings.h"
#include "settings/value_colors.h"

#include <optional>
#include <string>

namespace gnomon::settings {

/// The commands that draw. `Render` stands for each command that draws pictures without a path of frames to measure.
enum class DrawingCommand : std::uint8_t { Render, Bench, View };

/// An option that the backends of OpenGL cannot draw.
struct BackendNeed {
    std::string option; // as it is written, with its value
    std::string reason; // "only the software backend draws sections"
};

/// The facts that decide the backend.
struct BackendRequest {
    Backend requested = Backend::Auto;
    DrawingCommand command = DrawingCommand::Render;
    int pictures = 1;                // of a render
    bool hasGpu = false;             // of a view: the window's OpenGL is that of a GPU
    std::optional<BackendNeed> need; // of the requested options
};

/// A backend, never Auto, and the reason for it.
struct BackendChoice {
    Backend backend = Backend::Software;
    std::string reason; // half a sentence: "this machine has no GPU"
};

/// Returns the requested backend, or chooses one. The software backend draws one picture in less time than a GPU takes
/// to open, so `auto` uses a GPU for two or more pictures, for a bench and in the window. It never uses a GPU for
/// options with a need.
BackendChoice chooseBackend(const BackendRequest& request);

/// Returns the capabilities of `backend`, which is not Auto.
plan::Capabilities capabilitiesOf(Backend backend);

/// Returns "only the software backend draws sections" for the capability `sections`, and so on.
std::string onlySoftware(bool plan::Capabilities::*capability);

/// Returns the first option that a backend with `capabilities` cannot draw; nothing if it can draw all options.
std::optional<BackendNeed> unmetNeed(
    const Settings& settings, const ValueColors& colors, const plan::Capabilities& capabilities);

/// Returns the first option that only the software backend can draw.
std::optional<BackendNeed> softwareNeed(const Settings& settings, const ValueColors& colors = {});

/// Throws UsageError if the requested backend cannot draw the requested options.
void requireCapable(const Settings& settings, const ValueColors& colors = {});

} // namespace gnomon::settings
