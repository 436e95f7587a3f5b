// The options of lights: the Sun at a place and time, a point light, and the sky.
#pragma once

#include "hierarchy/model.h"
#include "settings/setting.h"
#include "sun/sun_position.h"

namespace gnomon::settings {

/// Returns the text codec for a place on the earth, "LAT,LON" in degrees. Its height is 0.
Codec<sun::Place> place();

/// Returns the text codec for a time in ISO 8601 with an offset from UTC, in the years 1 to 9999:
/// "2026-06-21T12:00+02:00".
Codec<sun::CivilTime> moment();

/// Returns the text codec for a duration above 0, such as "5m", "90s" or "1.5h". The value is in seconds.
Codec<double> duration();

/// Returns the text codec for the place and time of the Sun, "LAT,LON,TIME".
Codec<SunTime> sunTime();

/// Returns the text codec for the light of the sky. "N" means N directions of a uniform sky, and "N,MODEL" also names
/// the sky model.
Codec<plan::SkyLight> skyLight();

/// Returns the settings `--sun`, `--light-at`, `--north`, `--sun-angle`, `--light-error` and `--sky` for the table of
/// settings.
std::vector<Setting> sunSettings();

/// Computes the position of the Sun at `place` and `time`, and returns all three. Refraction is computed for standard
/// air.
SunTime sunAt(const sun::Place& place, const sun::CivilTime& time);

/// Throws UsageError if the Sun is below the horizon. The message says when the Sun is above it.
void requireSunUp(const SunTime& asked);

/// Returns the point light that `settings` request, or nullopt. Its position is rounded to the model's grid. Its
/// brightness equals that of the Sun at the distance d = sqrt(a^2 + b^2), where a is the distance of the light from the
/// bounding box of the model and b is 1/16 of the box's diagonal. A distant point light therefore lights the model as
/// the Sun does. Throws UsageError if another light is requested too, or if a coordinate is 2^51 grid cells or more
/// from the origin of the grid.
std::optional<plan::PointLight> pointLightOf(const Settings& settings, const hierarchy::ModelSummary& model);

/// Returns the angular diameter of the light's disc in radians. The requested angle has priority. Otherwise the Sun has
/// 0.5331 degrees divided by its distance in AU, and each other light has 0.
double lightDiameter(const Settings& settings);

/// Sets the light of `view`: its direction, the angular diameter of its disc, and the point light. `view.up` must
/// already be set. Throws UsageError for a point light that is too far away.
void setLight(const Settings& settings, const hierarchy::ModelSummary& model, plan::View& view);

} // namespace gnomon::settings
