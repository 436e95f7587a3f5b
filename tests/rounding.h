// The rounding of floating point as an input of a test: all of it upwards, downwards or to zero.
#pragma once

#include <cfenv>

namespace gnomon::tests {

/// This thread rounds by `mode` as long as it lives. What it calls must lie in another file, which is compiled for any
/// mode as nothing there reads or writes it.
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
