// The Sun as a light: how its place and time are written, and which way it lies.
#pragma once

#include "hierarchy/model.h"
#include "settings/setting.h"
#include "sun/sun_position.h"

namespace gnomon::settings {

/// "LAT,LON", degrees; the height stays 0.
Codec<sun::Place> place();

/// "2026-06-21T12:00+02:00", ISO 8601 with an offset, in the years from 1 to 9999.
Codec<sun::CivilTime> moment();

/// "5m", "90s", "1.5h": a time above 0, in seconds.
Codec<double> duration();

/// Both, "LAT,LON,TIME".
Codec<SunTime> sunTime();

/// "N", uniform, or "N,MODEL": directions of a sky.
Codec<plan::SkyLight> skyLight();

/// `--sun`, `--north` and what else says where light comes from: rows of the table of settings.
std::vector<Setting> sunSettings();

/// The direction towards a Sun that stands there, of unit length, as the air shows it, above the horizon or below, in a
/// world as below.
glm::dvec3 towardsSun(const sun::SunPosition& sun, double north, const glm::dvec3& up);

/// The direction towards the Sun, of unit length, as the usual air shows it, in a world in which `up` is up. True north
/// lies `north` degrees clockwise, seen from above, of the world's own, which is opposite its front: -z where y is up,
/// y where z is. Throws UsageError where the Sun is down, and says when it is up.
glm::dvec3 towardsSun(const SunTime& asked, double north, const glm::dvec3& up);

/// The lamp that is asked for, at the nearest point of the model's grid; nothing where there is none. It is as bright
/// as the sun at the distance d with d^2 = a^2 + b^2, a that of the model's box and b a sixteenth of its diagonal: from
/// far away it lights the model as the sun does. Throws UsageError beside another light, or beyond 2^51 cells.
std::optional<plan::PointLight> pointLightOf(const Settings& settings, const hierarchy::ModelSummary& model);

/// How wide the light's disc is seen, radians: what was asked for; else the Sun's at its place and time (0.5331 degrees
/// over its distance), and 0, a point, where the light is not the Sun's.
double lightDiameter(const Settings& settings);

} // namespace gnomon::settings
