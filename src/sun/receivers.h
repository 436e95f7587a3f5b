// The interface of receivers: points of a model for which each light direction is tested for shadow.
#pragma once

#include "exact/exact_shadows.h"

#include <cstdint>
#include <span>

namespace gnomon::sun {

/// A set of points that are tested for shadow, with indices from 0. The points and the shadow casters are the same for
/// all light directions.
class Receivers {
public:
    Receivers() = default;
    virtual ~Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    Receivers(Receivers&&) = delete;
    Receivers& operator=(Receivers&&) = delete;

    virtual std::size_t count() const = 0;

    /// Sets the element of `isLit` (`count()` elements) to 1 for each receiver that `light` reaches, and to 0 for all
    /// others. The result does not depend on the number of threads or on earlier lights. Runs in the caller's TBB
    /// arena.
    virtual exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) = 0;
};

} // namespace gnomon::sun
