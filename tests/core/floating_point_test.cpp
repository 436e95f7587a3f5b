// A process whose floating point was changed is refused, whichever way.
#include "core/error.h"
#include "core/process/floating_point.h"
#include "tests/support/rounding.h"

#include <gtest/gtest.h>

#include <cfenv>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace gnomon {
namespace {

TEST(FloatingPoint, IsRefusedWhereItRoundsOtherwise) {
    EXPECT_NO_THROW(requireUsualFloatingPoint());
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        const tests::RoundingMode rounding(mode);
        EXPECT_THROW(requireUsualFloatingPoint(), Error) << "rounding " << mode;
    }
    EXPECT_NO_THROW(requireUsualFloatingPoint());
}

#ifdef __SSE2__
TEST(FloatingPoint, IsRefusedWhereItFlushesSubnormals) {
    const unsigned usual = _mm_getcsr();
    for (const unsigned flag : {0x8000U, 0x0040U}) { // flush to zero, denormals are zero
        _mm_setcsr(usual | flag);
        EXPECT_THROW(requireUsualFloatingPoint(), Error) << "flag " << flag;
        _mm_setcsr(usual);
    }
}
#endif

} // namespace
} // namespace gnomon
