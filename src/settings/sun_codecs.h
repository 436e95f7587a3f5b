// How places and moments are written.
#pragma once

#include "settings/codec.h"
#include "sun/civil_time.h"
#include "sun/sun_position.h"

namespace gnomon::settings {

/// "LAT,LON", degrees; the height stays 0.
Codec<sun::Place> place();

/// "2026-06-21T12:00+02:00", ISO 8601 with an offset, in the years from 1 to 9999.
Codec<sun::CivilTime> moment();

} // namespace gnomon::settings
