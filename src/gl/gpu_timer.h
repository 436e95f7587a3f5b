// Measures the time of render passes with the clock of the GPU.
#pragma once

#include "core/units.h"
#include "gl/objects.h"

#include <array>
#include <cstddef>

namespace gnomon::gl {

/// Measures GPU times with two timestamp queries per render pass. It stores the queries of the last few passes, so that
/// `latest` never waits for the GPU.
class GpuTimer {
public:
    explicit GpuTimer(const Api& api);

    void begin();

    /// Ends the pass that `begin` started.
    void end();

    /// Waits for the GPU and returns the GPU time of the last render pass.
    Milliseconds finished();

    /// Returns the GPU time of the most recent render pass that the GPU has finished, or 0 if there is none. Does not
    /// wait.
    Milliseconds latest();

private:
    static constexpr std::size_t kPasses = 4;

    struct Pair {
        Object first;
        Object second;
    };

    Milliseconds read(std::size_t pass) const;

    const Api* api_;
    std::array<Pair, kPasses> pairs_;
    std::size_t passes_ = 0; // number of ended passes
    Milliseconds latest_;
};

} // namespace gnomon::gl
