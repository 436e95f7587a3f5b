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
    std::size_t texelMoved = 0;   // and by more than both maps' steps to a neighbour explain (see below)
    double largestTexelDepth = 0; // the largest such difference

    void operator+=(const ExecutorDifference& other);
};

/// Of the last frame of each. A card puts vertices on a grid of 1/256 texel and leaves their depths: so a depth may be
/// off by what the triangle's plane changes in that, which `texelMoved` grants as 1/128 of the largest step to a
/// neighbour.
ExecutorDifference difference(Executor& a, Executor& b);

} // namespace gnomon::executor
