// The clocks of this process: what its user waited since it was started, and what its threads computed.
#pragma once

#include "core/units.h"

namespace gnomon::telemetry {

/// Wall-clock time since the process was started, loading its libraries included; exact to 10 ms.
Milliseconds sinceProcessStart();

/// Processor time of all threads since the process was started.
Milliseconds processorTime();

} // namespace gnomon::telemetry
