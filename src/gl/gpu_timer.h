// How long a pass takes on the GPU, by its own clock.
#pragma once

#include "core/units.h"
#include "gl/objects.h"

#include <array>
#include <cstddef>

namespace gnomon::gl {

/// Two timestamps around a pass, of the last few passes: asking for the latest time that is known waits for nothing.
class GpuTimer {
public:
    explicit GpuTimer(const Api& api);

    void begin();

    /// Ends what `begin` began.
    void end();

    /// The time of the pass that ended last. Waits until the GPU has done it.
    Milliseconds finished();

    /// The time of the latest pass that the GPU is known to have done; 0 before the first.
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
    std::size_t passes_ = 0; // that ended
    Milliseconds latest_;
};

} // namespace gnomon::gl
