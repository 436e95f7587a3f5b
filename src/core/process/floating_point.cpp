#include "core/process/floating_point.h"

#include "core/error.h"

#include <cfenv>
#include <limits>

#ifdef __FAST_MATH__
#error "fast math: the compiler may take NaN and infinity for impossible, and sums for associative"
#endif

namespace gnomon {

namespace {

/// Returns true if this thread computes with subnormal numbers. The test is that half of the smallest normal number is
/// not 0, and that twice this half is the number again.
template <class Number>
bool keepsSubnormals() {
    // The variables are volatile, so that the processor and not the compiler computes the result.
    volatile Number value = std::numeric_limits<Number>::min();
    volatile Number half = value / 2;
    volatile Number whole = half * 2;
    return half > 0 && whole == value;
}

} // namespace

void requireUsualFloatingPoint() {
    const char* const kWhere = "floating point";
    if (std::fegetround() != FE_TONEAREST)
        throw Error(
            kWhere, "a loaded library changed the rounding mode of the processor", "to nearest", "another mode");
    if (!keepsSubnormals<float>() || !keepsSubnormals<double>())
        throw Error(
            kWhere,
            "a loaded library, perhaps compiled with -ffast-math, turned off subnormal numbers",
            "subnormal numbers",
            "zeros in their place");
}

} // namespace gnomon
