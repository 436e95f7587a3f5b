// Points of a model of which light after light is asked whether it reaches them.
#pragma once

#include "exact/exact_shadows.h"

#include <cstdint>
#include <span>

namespace gnomon::daylight {

/// Receivers are numbered from 0. Which there are, and what stands before them, is the same for all lights.
class Receivers {
public:
    Receivers() = default;
    virtual ~Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    Receivers(Receivers&&) = delete;
    Receivers& operator=(Receivers&&) = delete;

    virtual std::size_t count() const = 0;

    /// Sets `isLit`, of `count()` elements, to 1 where `light` reaches a receiver and 0 elsewhere. What comes out hangs
    /// on no thread and no light before. Runs in the caller's TBB arena.
    virtual exact::ExactStatistics decide(const IntegerLight& light, std::span<std::uint8_t> isLit) = 0;
};

} // namespace gnomon::daylight
