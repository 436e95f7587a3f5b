// Resource use of this process: wall-clock time, processor time and memory.
#pragma once

#include "core/units.h"

namespace gnomon::telemetry {

/// Returns the wall-clock time since the start of the process, including the loading of libraries. The resolution is 10
/// ms.
Milliseconds sinceProcessStart();

/// Returns the processor time of all threads since the start of the process.
Milliseconds processorTime();

/// Returns the peak resident memory so far.
Bytes peakResident();

} // namespace gnomon::telemetry
