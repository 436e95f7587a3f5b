// Measures the resources that this process uses: wall-clock time, processor time and memory.
#pragma once

#include "core/units.h"

namespace gnomon::telemetry {

/// Returns the wall-clock time since the start of the process, including the loading of libraries. The resolution is 10
/// ms.
Milliseconds sinceProcessStart();

/// Returns the processor time that all threads of this process have used since its start.
Milliseconds processorTime();

/// Returns the max resident memory of this process so far.
Bytes peakResident();

} // namespace gnomon::telemetry
