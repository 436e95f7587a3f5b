// Wall-clock time between two lines of code, by a clock that never goes back.
#pragma once

#include "core/units.h"

#include <chrono>

namespace gnomon {

/// Measures from its construction.
class Stopwatch {
public:
    /// The time since it was made.
    Milliseconds elapsed() const { return {std::chrono::duration<double, std::milli>(Clock::now() - start_).count()}; }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Adds the time that `work` takes, in milliseconds, to `sum`.
template <class Work>
void addTime(double& sum, const Work& work) {
    const Stopwatch watch;
    work();
    sum += watch.elapsed().count;
}

} // namespace gnomon
