// Measures wall-clock time with a monotonic clock.
#pragma once

#include "core/units.h"

#include <chrono>

namespace gnomon {

/// A stopwatch that starts when it is constructed.
class Stopwatch {
public:
    /// Returns the time since the construction.
    Milliseconds elapsed() const { return {std::chrono::duration<double, std::milli>(Clock::now() - start_).count()}; }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Runs `work` and adds its wall-clock duration in milliseconds to `sum`.
template <class Work>
void addTime(double& sum, const Work& work) {
    const Stopwatch watch;
    work();
    sum += watch.elapsed().count;
}

} // namespace gnomon
