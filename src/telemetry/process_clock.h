// What this process took: how long its user waited since it was started, what its threads computed, and memory.
#pragma once

#include "core/units.h"

namespace gnomon::telemetry {

/// Wall-clock time since the process was started, loading its libraries included; exact to 10 ms.
Milliseconds sinceProcessStart();

/// Processor time of all threads since the process was started.
Milliseconds processorTime();

/// The peak of its resident size so far.
Bytes peakResident();

} // namespace gnomon::telemetry
