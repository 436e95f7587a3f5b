// Preloaded into the program: changes how floating point works before main, as libraries do that fast math compiled.
#include <cfenv>
#include <cstdlib>
#include <string>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace {

/// As $CHANGED_FLOATS says: "upward", or "flushed".
__attribute__((constructor)) void changeFloats() {
    const char* asked = std::getenv("CHANGED_FLOATS");
    const std::string how = asked == nullptr ? "" : asked;
    if (how == "upward") std::fesetround(FE_UPWARD);
#ifdef __SSE2__
    if (how == "flushed") _mm_setcsr(_mm_getcsr() | 0x8040U); // flush to zero, denormals are zero
#endif
}

} // namespace
