// System and zstd functions that fail on demand. They replace the real ones in a test program.
#pragma once

#include <atomic>

namespace gnomon::tests {

/// The number of next calls that fail: file reads (EIO), creations of zstd contexts, and compressions (out of memory).
struct FailingCalls {
    std::atomic<int> reads{0};
    std::atomic<int> contexts{0};
    std::atomic<int> compressions{0};
};

/// Returns the counters of this program.
FailingCalls& failingCalls();

} // namespace gnomon::tests
