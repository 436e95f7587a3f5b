// Checks the floating-point mode of the processor. All arithmetic of Gnomon assumes default IEEE 754, but a loaded
// library can change the mode.
#pragma once

namespace gnomon {

/// Throws Error if the current thread does not round to nearest, or flushes subnormal numbers to zero (FTZ and DAZ). A
/// library that is compiled with fast math sets these modes for the whole process when it is loaded.
void requireUsualFloatingPoint();

} // namespace gnomon
