// The rounding mode of floating point as an input of a test: upwards, downwards or towards zero.
#pragma once

#include <cfenv>

namespace gnomon::tests {

/// Sets the rounding mode of this thread during its lifetime. The tested code must be in another file, because the
/// compiler then cannot assume a mode.
class RoundingMode {
public:
    explicit RoundingMode(int mode) { std::fesetround(mode); }

    ~RoundingMode() { std::fesetround(FE_TONEAREST); }

    RoundingMode(const RoundingMode&) = delete;
    RoundingMode& operator=(const RoundingMode&) = delete;
    RoundingMode(RoundingMode&&) = delete;
    RoundingMode& operator=(RoundingMode&&) = delete;
};

} // namespace gnomon::tests
