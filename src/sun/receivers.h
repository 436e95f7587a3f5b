// The interface of receivers: points of a model that are tested against one light direction after another.
#pragma once

#include "exact/exact_shadows.h"

#include <cstdint>
#include <span>

namespace gnomon::sun {

/// A set of receivers, numbered from 0. The receivers and the casters are the same for all lights.
class Receivers {
public:
    Receivers() = default;
    virtual ~Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    Receivers(Receivers&&) = delete;
    Receivers& operator=(Receivers&&) = delete;

    virtual std::size_t count() const = 0;

    /// Sets each element of `isLit` (`count()` elements) to 1 if `light` reaches the receiver, else to 0. The result
    /// does not depend on threads or earlier lights. Runs in the caller's TBB arena.
    virtual exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) = 0;
};

} // namespace gnomon::sun
