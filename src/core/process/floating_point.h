// What all arithmetic here takes for granted and a library loaded before us may have changed: IEEE 754 as it is by
// default.
#pragma once

namespace gnomon {

/// Throws Error where this thread rounds otherwise than to nearest, or takes subnormal numbers for zero or makes them
/// zero (FTZ and DAZ, which start-up code of libraries compiled with fast math sets for the whole process).
void requireUsualFloatingPoint();

} // namespace gnomon
