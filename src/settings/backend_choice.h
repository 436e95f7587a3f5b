// Selects the backend (software or OpenGL), and tells which options only the software backend can draw.
#pragma once

#include "settings/settings.h"
#include "settings/value_colors.h"

#include <optional>
#include <string>

namespace gnomon::settings {

/// The kind of command that draws: `gnomon bench`, `gnomon view`, or any other (`Render`).
enum class DrawingCommand : std::uint8_t { Render, Bench, View };

/// An option that the OpenGL backends cannot draw, with the reason.
struct BackendNeed {
    std::string option; // with its value, as on the command line: "--ground on"
    std::string reason; // half a sentence: "only the software backend draws sections"
};

/// The requested options and the machine's abilities, from which `chooseBackend` selects a backend.
struct BackendRequest {
    Backend requested = Backend::Auto;
    DrawingCommand command = DrawingCommand::Render;
    int pictures = 1;                // number of pictures of a render
    bool hasGpu = false;             // for a view: the OpenGL of the window runs on a GPU
    std::optional<BackendNeed> need; // the first requested option that only the software backend can draw
};

/// The chosen backend (never Auto) and the reason for this choice.
struct BackendChoice {
    Backend backend = Backend::Software;
    std::string reason; // half a sentence: "this machine has no GPU"
};

/// Returns the requested backend, or chooses one for `auto`. If an option needs the software backend, it is chosen.
/// Otherwise a GPU is chosen only for two or more pictures, for a bench and in the window. The software backend draws a
/// single picture in less time than a GPU takes to open.
BackendChoice chooseBackend(const BackendRequest& request);

/// Returns which effects `backend` can draw. It must not be Auto.
plan::Capabilities capabilitiesOf(Backend backend);

/// Returns half a sentence about a capability for messages. For `sections` it is "only the software backend draws
/// sections".
std::string onlySoftware(bool plan::Capabilities::*capability);

/// Returns the first requested option that a backend with `capabilities` cannot draw, or nullopt if it can draw all of
/// them.
std::optional<BackendNeed> missingCapability(
    const Settings& settings, const ValueColors& colors, const plan::Capabilities& capabilities);

/// Returns the first requested option that only the software backend can draw, or nullopt if there is none.
std::optional<BackendNeed> softwareNeed(const Settings& settings, const ValueColors& colors = {});

/// Throws UsageError if the requested backend cannot draw an option that the user requests. The backend can be Auto.
void requireCapable(const Settings& settings, const ValueColors& colors = {});

} // namespace gnomon::settings
