// How the pictures, depths and shadow maps of two executors differ after the same frame.
#pragma once

#include "executor/executor.h"

#include <cstddef>

namespace gnomon::executor {

/// Sums over frames.
struct ExecutorDifference {
    std::size_t pixels = 0;
    std::size_t coverage = 0;     // pixels that one alone covers
    std::size_t color = 0;        // pixels a channel of which differs by more than 2 levels
    std::size_t lit = 0;          // by how much they differ in pixels that the light reaches
    std::size_t texels = 0;       // of shadow maps, covered by both
    std::size_t texelCover = 0;   // by one alone
    std::size_t texelWrong = 0;   // of those covered by both: depths differ by more than 1e-5
    double largestTexelDepth = 0; // the largest such difference

    void operator+=(const ExecutorDifference& other);
};

/// Of the last frame of each.
ExecutorDifference difference(Executor& a, Executor& b);

} // namespace gnomon::executor
