// What the keys change of the settings.
#pragma once

#include "core/box.h"
#include "viewer/input/key_table.h"
#include "viewer/view_settings.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Shows or hides what `binding` is about; false if it is about something else.
bool changeShown(const Binding& binding, ViewSettings& settings);

/// Takes the step in quality that `binding` is, and returns what is now set, for people; nothing if it is about
/// something else.
std::optional<std::string> changeQuality(const Binding& binding, settings::Settings& settings);

/// Takes the sections away, puts a level one half way up a model within `bounds` (world space) or six around it, or
/// moves the most level one along `up`: what is above it is cut away. Returns what is now set, for people; nothing if
/// `binding` is about something else.
std::optional<std::string> changeSection(
    const Binding& binding, settings::Settings& settings, const Box& bounds, const glm::dvec3& up);

} // namespace gnomon::viewer
