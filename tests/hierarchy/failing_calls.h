// Calls of the system and of zstd that fail on demand: these stand before the real ones in a test program.
#pragma once

#include <atomic>

namespace gnomon::tests {

/// How many of the next calls fail: reads of files (EIO), contexts of zstd (none), compressions (no memory).
struct FailingCalls {
    std::atomic<int> reads{0};
    std::atomic<int> contexts{0};
    std::atomic<int> compressions{0};
};

/// Those of this program.
FailingCalls& failingCalls();

} // namespace gnomon::tests
