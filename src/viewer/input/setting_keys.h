// Applies keys to the settings.
#pragma once

#include "core/box.h"
#include "viewer/input/key_table.h"
#include "viewer/view_settings.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Shows or hides the element of `binding`. Returns false if the binding has another purpose.
bool changeShown(const Binding& binding, ViewSettings& settings);

/// Applies the quality step of `binding` and returns a description of the new value. Returns nothing if the binding has
/// another purpose.
std::optional<std::string> changeQuality(const Binding& binding, settings::Settings& settings);

/// Changes the sections of a model within `bounds` (world space): removes all, adds a horizontal one at half height,
/// adds a box of six, or moves the most horizontal one along `up`. Geometry above the horizontal section is cut off.
/// Returns a description of the new value, or nothing if `binding` has another purpose.
std::optional<std::string> changeSection(
    const Binding& binding, settings::Settings& settings, const Box& bounds, const glm::dvec3& up);

} // namespace gnomon::viewer
