// A check of the floating-point mode. All arithmetic here assumes default IEEE 754, but a loaded library can change the
// mode.
#pragma once

namespace gnomon {

/// Throws Error if this thread does not round to nearest, or flushes subnormal numbers to zero (FTZ and DAZ). Libraries
/// compiled with fast math set these modes for the whole process when they are loaded.
void requireUsualFloatingPoint();

} // namespace gnomon
