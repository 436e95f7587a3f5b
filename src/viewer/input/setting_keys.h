// Applies key presses to the settings of the window.
#pragma once

#include "core/box.h"
#include "viewer/input/key_table.h"
#include "viewer/view_settings.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Shows or hides the element of the window that `binding` names. Returns false if the key has another purpose.
bool changeShown(const Binding& binding, ViewSettings& settings);

/// Changes the quality setting that `binding` names by its step. Returns a description of the new value, or nullopt if
/// the key has another purpose.
std::optional<std::string> changeQuality(const Binding& binding, settings::Settings& settings);

/// Changes the section planes of a model within `bounds` (world space). Depending on `binding` it removes all planes,
/// adds a horizontal one at half height, adds a box of six, or moves the most horizontal one along `up`. A horizontal
/// plane removes the geometry above it. Returns a description of the new value, or nullopt if the key has another
/// purpose.
std::optional<std::string> changeSection(
    const Binding& binding, settings::Settings& settings, const Box& bounds, const glm::dvec3& up);

} // namespace gnomon::viewer
