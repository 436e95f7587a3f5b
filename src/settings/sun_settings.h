// The settings of lights: the Sun at a place and time, a point light, and the sky.
#pragma once

#include "hierarchy/model.h"
#include "settings/setting.h"
#include "sun/sun_position.h"

namespace gnomon::settings {

/// Returns the codec for a place "LAT,LON" in degrees. The height is 0.
Codec<sun::Place> place();

/// Returns the codec for a time in ISO 8601 with an offset from UTC, in the years 1 to 9999: "2026-06-21T12:00+02:00".
Codec<sun::CivilTime> moment();

/// Returns the codec for a duration above 0, such as "5m", "90s" or "1.5h". The value is in seconds.
Codec<double> duration();

/// Returns the codec for a place and a time, "LAT,LON,TIME".
Codec<SunTime> sunTime();

/// Returns the codec for the light of the sky: "N" directions of a uniform sky, or "N,MODEL".
Codec<plan::SkyLight> skyLight();

/// Returns the rows of the table of settings for `--sun`, `--light-at`, `--north`, `--sun-angle`, `--light-error` and
/// `--sky`.
std::vector<Setting> sunSettings();

/// Returns `place` and `time` with the position of the Sun there. Refraction is that of standard air.
SunTime sunAt(const sun::Place& place, const sun::CivilTime& time);

/// Throws UsageError if the Sun is down. The error says when it is up.
void requireSunUp(const SunTime& asked);

/// Returns the requested point light, moved to the nearest point of the model's grid; nullopt if none is requested. Its
/// brightness equals that of the Sun at the distance d = sqrt(a^2 + b^2), where a is its distance from the bounding box
/// of the model and b is 1/16 of the box's diagonal. A distant point light therefore lights the model as the Sun does.
/// Throws UsageError if another light is requested too, or if a coordinate is 2^51 cells or more from the origin of the
/// grid.
std::optional<plan::PointLight> pointLightOf(const Settings& settings, const hierarchy::ModelSummary& model);

/// Returns the angular diameter of the light's disc in radians. It is the requested angle, else the diameter of the Sun
/// at its place and time (0.5331 degrees divided by its distance in AU). For a light other than the Sun it is 0.
double lightDiameter(const Settings& settings);

/// Sets the light of `view`: its direction, the angular diameter of its disc, and the point light. `view.up` must be
/// set before. Throws UsageError for a point light that is too far away.
void setLight(const Settings& settings, const hierarchy::ModelSummary& model, plan::View& view);

} // namespace gnomon::settings
